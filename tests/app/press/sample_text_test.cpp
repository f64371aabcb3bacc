#include "app/press/sample_text.h"

#include "haptics/error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

TEST(SampleText, ReadsBackToTheLastBit)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-60, 4);
  for (int i = 0; i < 200'000; ++i)
  {
    const double meters = std::ldexp(mantissa(random), exponent(random));
    ASSERT_EQ(fromExactMillimeters(exactMillimeters(meters)), meters);
  }
}

TEST(SampleText, HasTheDigitsOfTheMeters)
{
  EXPECT_EQ(exactMillimeters(0.0123), "12.3");
  EXPECT_EQ(exactMillimeters(-0.005), "-5");
  EXPECT_EQ(exactMillimeters(1.5), "1500");
  EXPECT_EQ(exactMillimeters(1e-6), "0.001");
  EXPECT_EQ(exactMillimeters(2.5e-7), "0.00025");
  EXPECT_EQ(exactMillimeters(0.0), "0");
  EXPECT_EQ(exactMillimeters(INFINITY), "inf");
  EXPECT_EQ(fromExactMillimeters("12.3"), 0.0123);
  EXPECT_EQ(fromExactMillimeters("1e1"), 0.01);
  EXPECT_THROW((void)fromExactMillimeters("12.3mm"), Error);
}

} // namespace
} // namespace palp
