#include "haptics/force/ellipse.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(EllipseFactor, IsOneForACircleAndRises)
{
  const EllipseFactor factor;
  EXPECT_EQ(factor(0.0), 1.0);
  double previous = 1.0;
  for (double spread = 0.01; spread < EllipseFactor::kSlimmest; spread += 0.01)
  {
    EXPECT_GT(factor(spread), previous);
    previous = factor(spread);
  }
  EXPECT_EQ(factor(5.0), factor(EllipseFactor::kSlimmest));
}

// the shortcut of a sphere of radius sqrt(Ra Rb) falls short by 2.5 % at Ra = 3 Rb
TEST(EllipseFactor, MakesTheShortcutOfTheMeanRadiusFallShort)
{
  const EllipseFactor factor;
  const double ra = 3.0;
  const double rb = 1.0;
  const double spread = (ra - rb) / (ra + rb);                         // of 1 / 2R
  const double mean = factor(spread) / std::sqrt(0.5 / ra + 0.5 / rb); // F / (4/3 E* depth^1.5)
  EXPECT_NEAR(std::sqrt(std::sqrt(ra * rb)) / mean, 1.0 - 0.025, 0.001);
}

// Johnson 1985, Eqs. (4.24)-(4.28), solved here by bisection
TEST(EllipseFactor, SolvesHertzEquations)
{
  const EllipseFactor factor;
  for (const double spread : { 0.05, 0.2, 0.35, 0.5, 0.58 })
  {
    const double target = (1.0 - spread) / (1.0 + spread); // A / B
    double low = 1e-6;
    double high = 1.0 - 1e-6;
    for (int i = 0; i < 100; ++i)
    {
      const double aspect2 = 0.5 * (low + high); // b^2 / a^2
      const double k = std::comp_ellint_1(std::sqrt(1.0 - aspect2));
      const double e = std::comp_ellint_2(std::sqrt(1.0 - aspect2));
      ((k - e) / (e / aspect2 - k) < target ? low : high) = aspect2;
    }
    // F = (2/3) pi E* depth a / K at depth 1, A = 1 - spread, B = 1 + spread
    const double k = std::comp_ellint_1(std::sqrt(1.0 - low));
    const double e = std::comp_ellint_2(std::sqrt(1.0 - low));
    const double a = std::sqrt((k - e) / ((1.0 - spread) * (1.0 - low) * k));
    const double elliptic = 2.0 / 3.0 * std::acos(-1.0) * a / k;
    const double circular = 4.0 / 3.0 / std::sqrt(2.0);
    EXPECT_NEAR(factor(spread), elliptic / circular, 1e-4);
  }
}

} // namespace
} // namespace palp
