#include "pipeline/length_unit.h"

#include "haptics/error.h"

#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

std::string refusal(double longestSide)
{
  try
  {
    const LengthUnit unit = guessUnit(longestSide, "body.stl");
    return std::string("taken in ") + unitName(unit);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadMesh);
    return error.what();
  }
}

TEST(LengthUnit, IsTheOneThatGivesTheSizeOfAnOrgan)
{
  EXPECT_EQ(guessUnit(230.0, ""), LengthUnit::Millimetre);
  EXPECT_EQ(guessUnit(23.0, ""), LengthUnit::Centimetre);
  EXPECT_EQ(guessUnit(0.23, ""), LengthUnit::Metre);
}

TEST(LengthUnit, CountsTheLimitsOf30And600MillimetresIn)
{
  EXPECT_EQ(guessUnit(600.0, ""), LengthUnit::Millimetre);
  EXPECT_EQ(guessUnit(3.0, ""), LengthUnit::Centimetre);
  EXPECT_EQ(guessUnit(0.03, ""), LengthUnit::Metre);
  EXPECT_EQ(guessUnit(0.6, ""), LengthUnit::Metre);
}

TEST(LengthUnit, IsRefusedWhereTwoFit)
{
  // 30 to 60 is an organ in millimetres and in centimetres
  for (const double side : { 30.0, 45.0, 60.0 })
  {
    EXPECT_NE(refusal(side).find("more than one unit"), std::string::npos) << side;
  }
  EXPECT_EQ(guessUnit(29.9, ""), LengthUnit::Centimetre);
  EXPECT_EQ(guessUnit(60.1, ""), LengthUnit::Millimetre);
}

TEST(LengthUnit, IsRefusedWhereNoneFitsAndSaysWhatEachWouldGive)
{
  for (const double side : { 0.0, 0.02, 1.0, 601.0, 1e9 })
  {
    EXPECT_NE(refusal(side).find("no unit"), std::string::npos) << side;
  }
  EXPECT_EQ(refusal(2.0),
    "body.stl: no unit gives the size of an organ (longest side 2 mm if mm, 20 mm if cm, "
    "2000 mm if m); give --unit mm, cm or m");
}

TEST(LengthUnit, IsReadFromTheWordsOfTheOption)
{
  EXPECT_EQ(parseUnit("mm"), LengthUnit::Millimetre);
  EXPECT_EQ(parseUnit("cm"), LengthUnit::Centimetre);
  EXPECT_EQ(parseUnit("m"), LengthUnit::Metre);
  EXPECT_EQ(parseUnit("auto"), std::nullopt);
  for (const char* text : { "", "MM", "inch", "mm ", "km" })
  {
    EXPECT_THROW((void)parseUnit(text), Error) << text;
  }
}

} // namespace
} // namespace palp::test
