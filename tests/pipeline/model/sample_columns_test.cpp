#include "pipeline/model/sample_columns.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace palp
{
namespace
{

double signal(int i)
{
  return std::sin(0.01 * i) + 0.1 * std::sin(1.7 * i);
}

std::vector<SampleColumns::Column> columnsOf(const SampleColumns& columns)
{
  std::vector<SampleColumns::Column> all;
  columns.forEach([&](const SampleColumns::Column& column) { all.push_back(column); });
  return all;
}

TEST(SampleColumns, KeepsTheExtremesOfEveryColumnOfTheLastMinute)
{
  SampleColumns columns(60.0, 800);
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i)
  {
    columns.add(0.001 * i, signal(i));
  }
  const auto all = columnsOf(columns);
  ASSERT_EQ(all.size(), 800U);
  EXPECT_NEAR(all.front().start, 40.0, 0.1);
  for (const auto& column : all)
  {
    double least = 1e9;
    double largest = -1e9;
    for (int i = 0; i < kSamples; ++i)
    {
      if (0.001 * i >= column.start && 0.001 * i < column.start + 0.075)
      {
        least = std::min(least, signal(i));
        largest = std::max(largest, signal(i));
      }
    }
    EXPECT_EQ(column.least, least);
    EXPECT_EQ(column.largest, largest);
  }
}

TEST(SampleColumns, BeginsNarrowAndLosesNothingWhenItWidens)
{
  SampleColumns columns(60.0, 800);
  double largest = 0.0;
  for (int i = 0; i < 50'000; ++i)
  {
    const double value = i == 1234 ? 9.0 : signal(i);
    columns.add(0.001 * i, value);
    largest = std::max(largest, value);
    if (i == 3000)
    {
      EXPECT_GT(columnsOf(columns).size(), 600U); // 3 s in columns of under 5 ms
    }
  }
  double seen = 0.0;
  for (const auto& column : columnsOf(columns))
  {
    seen = std::max(seen, column.largest);
  }
  EXPECT_EQ(seen, largest);
}

TEST(SampleColumns, LeavesAGapWhereNothingWasMeasured)
{
  SampleColumns columns(60.0, 600);
  columns.add(0.0, 1.0);
  columns.add(50.0, 2.0);
  columns.add(1000.0, 3.0);
  const auto all = columnsOf(columns);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].least, 3.0);
}

TEST(SampleColumns, TakesNoValueThatIsNotFinite)
{
  SampleColumns columns(60.0, 600);
  columns.add(1.0, std::numeric_limits<double>::quiet_NaN());
  columns.add(std::numeric_limits<double>::infinity(), 1.0);
  columns.add(-1.0, 1.0);
  EXPECT_TRUE(columnsOf(columns).empty());
}

} // namespace
} // namespace palp
