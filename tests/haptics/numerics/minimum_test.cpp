#include "haptics/numerics/minimum.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

TEST(Minimum, OfAParabolaIsFoundAtOnce)
{
  int calls = 0;
  const auto parabola = [&calls](double x)
  {
    ++calls;
    return (x - 0.3) * (x - 0.3);
  };
  const Minimum found = minimize(parabola, { -1.0, 2.0 }, { 0.0, 0.09 }, 1e-9);
  EXPECT_NEAR(found.at, 0.3, 1e-9);
  EXPECT_LT(calls, 20); // 45 by golden sections alone
}

TEST(Minimum, IsFoundWhereTheFunctionHasACorner)
{
  const Minimum found =
    minimize([](double x) { return std::abs(x - 0.7); }, { 0.0, 1.0 }, { 0.5, 0.2 }, 1e-9);
  EXPECT_NEAR(found.at, 0.7, 1e-8);
}

TEST(Minimum, AtAnEndIsApproached)
{
  const Minimum found = minimize([](double x) { return x; }, { 1.0, 2.0 }, { 1.0, 1.0 }, 1e-9);
  EXPECT_NEAR(found.at, 1.0, 1e-8);
}

TEST(Minimum, OfSeveralTheLowestOfTheGridIsTaken)
{
  // cos(x) + x / 20: minima near pi, 3 pi and 5 pi, each higher than the one before
  const std::array grid{ 0.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0 };
  const Minimum found = minimizeAmong([](double x) { return std::cos(x) + x / 20.0; }, grid, 1e-9);
  EXPECT_NEAR(found.at, std::numbers::pi - std::asin(0.05), 1e-7);
}

} // namespace
} // namespace palp
