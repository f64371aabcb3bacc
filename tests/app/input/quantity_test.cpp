#include "app/input/quantity.h"

#include "haptics/error.h"

#include <clocale>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

std::string messageOf(std::string_view text, Quantity kind)
{
  try
  {
    (void)parseQuantity(text, kind, "--young");
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "accepted";
}

TEST(Quantity, ReadsEveryUnitAsItsExactSize)
{
  EXPECT_EQ(parseQuantity("10mm", Quantity::Length, "r"), 0.01);
  EXPECT_EQ(parseQuantity("250um", Quantity::Length, "r"), 250e-6);
  EXPECT_EQ(parseQuantity("1.5cm", Quantity::Length, "r"), 0.015);
  EXPECT_EQ(parseQuantity("+1m", Quantity::Length, "r"), 1.0);
  EXPECT_EQ(parseQuantity("1.5e+06Pa", Quantity::Pressure, "E"), 1.5e6);
  EXPECT_EQ(parseQuantity("50kPa", Quantity::Pressure, "E"), 50e3);
  EXPECT_EQ(parseQuantity("1.5MPa", Quantity::Pressure, "E"), 1.5e6);
  EXPECT_EQ(parseQuantity("10GPa", Quantity::Pressure, "E"), 1e10);
  EXPECT_NEAR(parseQuantity("45deg", Quantity::Angle, "a"), std::atan(1.0), 1e-16);
  EXPECT_EQ(parseQuantity("0.5rad", Quantity::Angle, "a"), 0.5);
  EXPECT_EQ(parseQuantity("2N*s/m", Quantity::Damping, "b"), 2.0);
}

TEST(Quantity, RefusesABareNumberWithTheFix)
{
  EXPECT_EQ(messageOf("50", Quantity::Pressure),
    "--young: '50' has no unit; write 50kPa (kPa, Pa, MPa, GPa)");
}

// else the fix is the next refusal
TEST(Quantity, SuggestsTheUnitThatFitsItsRange)
{
  const auto said = [](std::string_view text, Quantity kind, const Bounds& bounds)
  {
    try
    {
      (void)parseWithin(text, kind, bounds, "--it");
    }
    catch (const Error& error)
    {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const Bounds rates{ 1000.0, 4000.0, "1kHz to 4kHz" };
  EXPECT_NE(said("5", Quantity::Time, { 1e-5, 0.01, "0.01ms to 10ms" }).find("write 5ms"),
    std::string::npos);
  EXPECT_NE(said("1000", Quantity::Frequency, rates).find("write 1000Hz"), std::string::npos);
  EXPECT_NE(said("2", Quantity::Frequency, rates).find("write 2kHz"), std::string::npos);
  EXPECT_NE(said("9", Quantity::Frequency, rates).find("has no unit"), std::string::npos);
}

TEST(Quantity, ReadsSpacesAndTheSignsThatPeopleWrite)
{
  EXPECT_EQ(parseQuantity(" 10 mm ", Quantity::Length, "r"), 0.01);
  EXPECT_EQ(
    parseQuantity("45°", Quantity::Angle, "a"), parseQuantity("45deg", Quantity::Angle, "a"));
  EXPECT_EQ(parseQuantity("2 N·s/m", Quantity::Damping, "b"), 2.0);
}

TEST(Quantity, TakesTheUsualUnitOnlyWhereNoneIsGiven)
{
  EXPECT_EQ(parseQuantity("10", Quantity::Length, "r", "mm"), 0.01);
  EXPECT_EQ(parseQuantity("10 cm", Quantity::Length, "r", "mm"), 0.1);
  EXPECT_THROW((void)parseQuantity("10 kPa", Quantity::Length, "r", "mm"), Error);
  EXPECT_THROW((void)parseQuantity("", Quantity::Length, "r", "mm"), Error);
}

TEST(Quantity, TellsOfADecimalComma)
{
  EXPECT_EQ(messageOf("12,5kPa", Quantity::Pressure),
    "--young: '12,5kPa' has a comma; write decimals with a point, like 12.5");
}

TEST(Quantity, HasOnePointAtMost)
{
  EXPECT_EQ(messageOf("1.234.5", Quantity::Pressure),
    "--young: '1.234.5' is not a number; write it like 10 or 1.5e+06");
}

TEST(Quantity, RefusesAnotherQuantitysUnit)
{
  EXPECT_EQ(messageOf("50mm", Quantity::Pressure),
    "--young: '50mm' has the unit 'mm'; use one of kPa, Pa, MPa, GPa");
}

TEST(Quantity, RefusesWhatIsNoFiniteNumber)
{
  for (const char* text :
    { "", "kPa", "nankPa", "infkPa", "1e999kPa", "--5kPa", "0x10kPa", "5,0kPa" })
  {
    EXPECT_NE(messageOf(text, Quantity::Pressure), "accepted") << text;
  }
}

TEST(Quantity, DoesNotFollowTheUsersLocale)
{
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  EXPECT_EQ(parseQuantity("1.5mm", Quantity::Length, "r"), 0.0015) << (german ? german : "C");
  std::setlocale(LC_ALL, "C");
}

TEST(Quantity, ABareNumberMustBeBare)
{
  EXPECT_EQ(parseNumber("0.33", "nu"), 0.33);
  EXPECT_THROW((void)parseNumber("0.33Pa", "nu"), Error);
}

TEST(Labels, StandInQuotesWhereANameHoldsAComma)
{
  using Words = std::vector<std::string>;
  EXPECT_EQ(parseLabels("1, liver", "--label"), (Words{ "1", "liver" }));
  EXPECT_EQ(parseLabels("\"Liver, right lobe\",4", "--label"), (Words{ "Liver, right lobe", "4" }));
  EXPECT_THROW((void)parseLabels("1,,2", "--label"), Error);
  EXPECT_THROW((void)parseLabels("1,2,1", "--label"), Error);
}

TEST(Range, IncludesBothEnds)
{
  const Range range = parseRange("0:10:0.5mm", Quantity::Length, "d");
  ASSERT_EQ(range.si.size(), 21u);
  EXPECT_EQ(range.si.front(), 0.0);
  EXPECT_EQ(range.si.back(), 0.01);
  EXPECT_EQ(range.given[7], 3.5);
  EXPECT_EQ(parseRange("0mm:1mm:0.1mm", Quantity::Length, "d").si.size(), 11u);
}

TEST(Range, AddsAnEndThatTheStepsMiss)
{
  EXPECT_EQ(parseRange("0:1:0.3mm", Quantity::Length, "d").given,
    (std::vector<double>{ 0.0, 0.3, 0.6, 3 * 0.3, 1.0 }));
}

TEST(Range, EqualEndsGiveOneValue)
{
  EXPECT_EQ(parseRange("2:2:1mm", Quantity::Length, "d").si, std::vector<double>{ 0.002 });
}

TEST(Quantity, ReadsMicrometersHoweverTheyAreWritten)
{
  for (const char* text : { "250um", "250\u00B5m", "250 \u03BCm" })
  {
    EXPECT_EQ(parseQuantity(text, Quantity::Length, "r"), 250e-6) << text;
  }
  EXPECT_THROW((void)parseQuantity("250\u00B5Pa", Quantity::Pressure, "p"), Error);
}

TEST(Quantity, NumbersHaveOneCommaBetweenThem)
{
  EXPECT_EQ(parseNumbers("5", "--label"), (std::vector<double>{ 5.0 }));
  EXPECT_EQ(parseNumbers("1, 2,7", "--label"), (std::vector<double>{ 1.0, 2.0, 7.0 }));
  for (const char* text : { "", "5,,7", ",5", "5,", "5, ", "5 7", "5;7" })
  {
    EXPECT_THROW((void)parseNumbers(text, "--label"), Error) << text;
  }
}

TEST(Range, RefusesWhatDoesNotGoUp)
{
  for (const char* text :
    { "1:0:0.5mm", "0:1:0mm", "0:1:-1mm", "0:1", "0:1:1", "0m:1mm:1mm", "0:1:1e-9mm" })
  {
    EXPECT_THROW((void)parseRange(text, Quantity::Length, "d"), Error) << text;
  }
}

} // namespace
} // namespace palp
