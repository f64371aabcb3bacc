#include "haptics/numerics/monotone_cubic.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(Hermite, MeetsValuesAndSlopesAtBothEnds)
{
  const Cubic start = hermite(0.0, 2.0, 3.0, 7.0, 0.5, -1.0);
  const Cubic end = hermite(1.0, 2.0, 3.0, 7.0, 0.5, -1.0);
  EXPECT_DOUBLE_EQ(start.value, 3.0);
  EXPECT_DOUBLE_EQ(start.slope, 0.5);
  EXPECT_DOUBLE_EQ(end.value, 7.0);
  EXPECT_DOUBLE_EQ(end.slope, -1.0);
}

TEST(Hermite, IsExactForACubic)
{
  // x^3 from 1 to 3, read at 2.5
  const Cubic cubic = hermite(0.75, 2.0, 1.0, 27.0, 3.0, 27.0);
  EXPECT_DOUBLE_EQ(cubic.value, 15.625);
  EXPECT_DOUBLE_EQ(cubic.slope, 18.75);
}

TEST(PolynomialSlopes, AreExactForTheFourthDegreeAndUnevenPoints)
{
  const std::vector<double> x{ 0.0, 0.3, 0.7, 1.6, 2.0, 3.1, 3.5 };
  std::vector<double> y;
  for (const double at : x)
  {
    y.push_back(at * at * at * at - 2.0 * at);
  }
  const std::vector<double> slopes = polynomialSlopes(x, y);
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    EXPECT_NEAR(slopes[i], 4.0 * x[i] * x[i] * x[i] - 2.0, 1e-11) << i;
  }
}

TEST(PolynomialSlopes, OfTwoPointsAreTheirChord)
{
  const std::vector<double> slopes =
    polynomialSlopes(std::vector{ 1.0, 3.0 }, std::vector{ 2.0, 8.0 });
  EXPECT_DOUBLE_EQ(slopes[0], 3.0);
  EXPECT_DOUBLE_EQ(slopes[1], 3.0);
}

// a step, at which the polynomial would swing over
TEST(MonotoneSlopes, KeepTheCurveBetweenItsPoints)
{
  const std::vector<double> x{ 0.0, 1.0, 2.0, 3.0, 4.0, 5.0 };
  const std::vector<double> y{ 0.0, 0.0, 0.1, 5.0, 5.0, 4.0 };
  const std::vector<double> slopes = monotoneSlopes(x, y);
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
  {
    for (double fraction = 0.0; fraction <= 1.0; fraction += 0.01)
    {
      const double value = hermite(fraction, 1.0, y[i], y[i + 1], slopes[i], slopes[i + 1]).value;
      EXPECT_GE(value, std::min(y[i], y[i + 1]) - 1e-12);
      EXPECT_LE(value, std::max(y[i], y[i + 1]) + 1e-12);
    }
  }
}

TEST(MonotoneCubic, BracketHoldsTheValueAndEndsAtTheBorder)
{
  const std::vector<double> axis{ 1.0, 2.0, 4.0 };
  const auto expect = [&](double value, std::size_t low, double fraction)
  {
    EXPECT_EQ(bracket(axis, value).low, low) << value;
    EXPECT_DOUBLE_EQ(bracket(axis, value).fraction, fraction) << value;
  };
  expect(0.0, 0, 0.0);
  expect(1.5, 0, 0.5);
  expect(2.0, 1, 0.0);
  expect(3.5, 1, 0.75);
  expect(4.0, 1, 1.0);
  expect(9.0, 1, 1.0);
  EXPECT_EQ(bracket(std::vector{ 3.0 }, 7.0).low, 0U);
  EXPECT_EQ(bracket(std::vector{ 3.0 }, 7.0).fraction, 0.0);
}

TEST(MonotoneCubic, CurveGoesThroughItsPointsAndStaysBeyond)
{
  const std::vector<double> x{ 0.0, 1.0, 3.0 };
  const std::vector<double> y{ 0.0, 1.0, 27.0 };
  const std::vector<double> slopes{ 0.0, 3.0, 27.0 }; // of x^3, which a cubic is
  for (const double at : { 0.0, 0.3, 1.0, 1.7, 3.0 })
  {
    EXPECT_NEAR(cubicAt(x, y, slopes, at).value, at * at * at, 1e-13);
    EXPECT_NEAR(cubicAt(x, y, slopes, at).slope, 3.0 * at * at, 1e-13);
  }
  EXPECT_EQ(cubicAt(x, y, slopes, -1.0).value, 0.0);
  EXPECT_EQ(cubicAt(x, y, slopes, 5.0).value, 27.0);
}

} // namespace
} // namespace palp
