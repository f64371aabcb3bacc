#include "haptics/numerics/cubic_spline.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

double cube(double x)
{
  return x * x * x;
}

constexpr SplineAxis kX{ -1.0, 2.0, 6 };
constexpr SplineAxis kY{ 0.5, 2.5, 5 };

TEST(CubicSpline, IsExactForACubicAndStaysBeyondItsEnds)
{
  std::vector<double> values;
  for (int i = 0; i <= kX.intervals; ++i)
  {
    values.push_back(cube(kX.first + i * kX.step()));
  }
  const CubicSpline spline(kX, values);
  for (double at = -1.0; at <= 2.0; at += 0.07)
  {
    EXPECT_NEAR(spline(at).value, cube(at), 1e-13);
    EXPECT_NEAR(spline(at).slope, 3.0 * at * at, 1e-12);
    EXPECT_NEAR(spline(at).bend, 6.0 * at, 1e-11);
  }
  EXPECT_DOUBLE_EQ(spline(5.0).value, spline(2.0).value);
  EXPECT_DOUBLE_EQ(spline(-5.0).value, spline(-1.0).value);
}

TEST(BicubicSpline, IsExactForAProductOfCubics)
{
  std::vector<double> values;
  for (int i = 0; i <= kX.intervals; ++i)
  {
    for (int j = 0; j <= kY.intervals; ++j)
    {
      values.push_back(cube(kX.first + i * kX.step()) * cube(kY.first + j * kY.step()));
    }
  }
  const BicubicSpline spline(kX, kY, values);
  for (double x = -0.99; x < 2.0; x += 0.31)
  {
    for (double y = 0.51; y < 2.5; y += 0.23)
    {
      const BicubicSpline::Value at = spline(x, y);
      EXPECT_NEAR(at.value, cube(x) * cube(y), 1e-11);
      EXPECT_NEAR(at.x, 3.0 * x * x * cube(y), 1e-10);
      EXPECT_NEAR(at.y, cube(x) * 3.0 * y * y, 1e-10);
      EXPECT_NEAR(at.yy, cube(x) * 6.0 * y, 1e-9);
    }
  }
}

// a force that is a slope, and a stiffness that is a bend, must not jump
TEST(CubicSpline, BendIsContinuousAtItsPoints)
{
  std::vector<double> values;
  for (int i = 0; i <= 20; ++i)
  {
    values.push_back(std::sin(0.7 * i));
  }
  const CubicSpline spline({ 0.0, 20.0, 20 }, values);
  for (int i = 1; i < 20; ++i)
  {
    EXPECT_NEAR(spline(i - 1e-9).bend, spline(i + 1e-9).bend, 1e-7);
    EXPECT_NEAR(spline(i).value, values[static_cast<std::size_t>(i)], 1e-13);
  }
}

} // namespace
} // namespace palp
