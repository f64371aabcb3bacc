#include "app/sweep/sweep_range.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace palp
{
namespace
{

TEST(SweepRange, OfEvenStepsHasNoDigitsOfRounding)
{
  const std::vector<std::string> expected{ "0.3", "0.36", "0.42", "0.48" };
  EXPECT_EQ(evenly({ 0.3, 0.48, "" }, 4), expected);
  const std::vector<std::string> decades{ "1kPa", "10kPa", "100kPa" };
  EXPECT_EQ(evenly({ 1.0, 100.0, "kPa", true }, 3), decades);
}

TEST(SweepRange, TakesNumbersApartFromUnits)
{
  EXPECT_EQ(numberText("12.5 N*s/m")->unit, "N*s/m");
  EXPECT_EQ(numberText("-3e2")->number, -300.0);
  for (const char* text :
    { "", "mm", "sphere:10mm", "1:2mm", "nan", "infinity", "10mm,5mm", "1e999" })
  {
    EXPECT_FALSE(numberText(text)) << text;
  }
}

// the definition of McKay, Beckman and Conover
TEST(LatinHypercube, MeetsEachPartOfEachRangeOnce)
{
  constexpr std::size_t count = 257;
  const auto rows = latinHypercube({ { 0.0, 1.0, "" }, { 1.0, 1000.0, "kPa", true } }, count, 7);
  std::set<int> linear;
  std::set<int> decades;
  for (const auto& row : rows)
  {
    linear.insert(static_cast<int>(count * numberText(row[0])->number));
    decades.insert(static_cast<int>(count * std::log10(numberText(row[1])->number) / 3.0));
  }
  EXPECT_EQ(linear.size(), count);
  EXPECT_EQ(decades.size(), count);
  EXPECT_EQ(*linear.rbegin(), static_cast<int>(count) - 1);
}

// correlation of independent samples of this count stays within four of its standard deviations
TEST(LatinHypercube, DoesNotTieOneRangeToAnother)
{
  constexpr std::size_t count = 1000;
  const auto rows = latinHypercube({ { 0.0, 1.0, "" }, { 0.0, 1.0, "" } }, count, 1);
  double product = 0.0;
  for (const auto& row : rows)
  {
    product += 12.0 * (numberText(row[0])->number - 0.5) * (numberText(row[1])->number - 0.5);
  }
  EXPECT_LT(std::abs(product / count), 4.0 / std::sqrt(count));
  EXPECT_EQ(rows, latinHypercube({ { 0.0, 1.0, "" }, { 0.0, 1.0, "" } }, count, 1));
  EXPECT_NE(rows, latinHypercube({ { 0.0, 1.0, "" }, { 0.0, 1.0, "" } }, count, 2));
}

} // namespace
} // namespace palp
