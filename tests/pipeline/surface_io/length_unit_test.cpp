#include "pipeline/surface_io/length_unit.h"

#include "haptics/error.h"

#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

std::string refusal(double longestSide, double field = 0.0)
{
  try
  {
    const LengthUnit unit = guessUnit(longestSide, "body.stl", field);
    return std::string("taken in ") + unitName(unit);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    return error.what();
  }
}

TEST(LengthUnit, IsTheOneThatGivesTheSizeOfAnOrgan)
{
  EXPECT_EQ(guessUnit(230.0, ""), LengthUnit::Millimeter);
  EXPECT_EQ(guessUnit(3.2, ""), LengthUnit::Centimeter);
  EXPECT_EQ(guessUnit(0.23, ""), LengthUnit::Meter);
}

TEST(LengthUnit, CountsTheLimitsOf5And600MillimetersIn)
{
  EXPECT_EQ(guessUnit(600.0, ""), LengthUnit::Millimeter);
  EXPECT_EQ(guessUnit(0.61, ""), LengthUnit::Centimeter);
  EXPECT_EQ(guessUnit(0.005, ""), LengthUnit::Meter);
  EXPECT_EQ(guessUnit(0.49, ""), LengthUnit::Meter);
}

TEST(LengthUnit, IsRefusedWhereTwoFit)
{
  // a valve of 25.7 mm would be a liver of 257 mm; a block of 0.55 cm one of 550 mm
  for (const double side : { 5.0, 6.4, 25.7, 45.0, 60.0, 0.5, 0.55 })
  {
    EXPECT_NE(refusal(side).find("more than one unit"), std::string::npos) << side;
  }
  EXPECT_EQ(guessUnit(4.9, ""), LengthUnit::Centimeter);
  EXPECT_EQ(guessUnit(60.1, ""), LengthUnit::Millimeter);
}

// millimeters, but no other of several
TEST(LengthUnit, OfASurfaceThatStatesItsAxesIsThatOf3DSlicer)
{
  for (const double side : { 5.0, 25.7, 60.0, 600.0 })
  {
    EXPECT_EQ(guessUnit(side, "", 0.0, true), LengthUnit::Millimeter) << side;
  }
  EXPECT_EQ(guessUnit(0.23, "", 0.0, true), LengthUnit::Meter);
  for (const double side : { 0.5, 0.55, 700.0 }) // of cm and m, or of none
  {
    EXPECT_THROW((void)guessUnit(side, "", 0.0, true), Error) << side;
  }
}

// a lesion of 4.1 mm is none of 41 mm, and a kidney of 50 mm none of 500 mm
TEST(LengthUnit, OfARegionIsThatOfItsImage)
{
  for (const double side : { 0.6, 4.1, 50.0, 230.0 })
  {
    EXPECT_EQ(refusal(side, 320.0), "taken in mm") << side;
    EXPECT_EQ(refusal(1e-3 * side, 0.32), "taken in m") << side;
  }
  EXPECT_EQ(refusal(500.0, 2000.0), "taken in mm");
  for (const double side : { 0.6, 4.1, 41.0 }) // of 60 mm, or of 600
  {
    EXPECT_NE(refusal(side, 60.0).find("more than one unit"), std::string::npos) << side;
  }
}

TEST(LengthUnit, IsRefusedWhereNoneFitsAndSaysWhatEachWouldGive)
{
  for (const double side : { 0.0, 0.0049, 601.0, 1e9 })
  {
    EXPECT_NE(refusal(side).find("no unit"), std::string::npos) << side;
  }
  EXPECT_EQ(refusal(2000.0),
    "body.stl: no unit gives the size of an organ or a part of one (longest side 2000 mm if mm, "
    "20000 mm if cm, 2e+06 mm if m); give the unit, mm, cm or m (--unit)");
}

TEST(LengthUnit, IsReadFromTheWordsOfTheOption)
{
  EXPECT_EQ(parseUnit("mm"), LengthUnit::Millimeter);
  EXPECT_EQ(parseUnit("cm"), LengthUnit::Centimeter);
  EXPECT_EQ(parseUnit("m"), LengthUnit::Meter);
  EXPECT_EQ(parseUnit("auto"), std::nullopt);
  for (const char* text : { "", "MM", "inch", "mm ", "km" })
  {
    EXPECT_THROW((void)parseUnit(text), Error) << text;
  }
}

} // namespace
} // namespace palp::test
