#include "haptics/numerics/angle.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

TEST(Angle, IsTheArctangentOfEveryQuadrant)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  std::uniform_real_distribution<double> size(-30.0, 30.0);
  for (int i = 0; i < 100000; ++i)
  {
    const double length = std::pow(10.0, size(random));
    const double at = angle(random) * (i % 2 == 0 ? 1.0 : 0.05);
    const double sine = length * std::sin(at);
    const double cosine = length * std::cos(at);
    EXPECT_NEAR(angleOf(sine, cosine), std::atan2(sine, cosine), 1e-15) << at;
  }
}

TEST(Angle, IsThatOfTheAxesAndOfNothing)
{
  for (const double sine : { -1.0, -0.0, 0.0, 1.0 })
  {
    for (const double cosine : { -1.0, 0.0, 1.0 })
    {
      const double expected = sine == 0.0 && cosine == 0.0 ? 0.0 : std::atan2(sine, cosine);
      EXPECT_DOUBLE_EQ(angleOf(sine, cosine), expected) << sine << ' ' << cosine;
    }
  }
}

} // namespace
} // namespace palp
