#include "haptics/force/linear/contact_pressure.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

// p = p0 sqrt(1 - (r/a)^2), p0 = 3 F / (2 pi a^2)
TEST(ContactPressure, OfAParaboloidIsHertzs)
{
  const double a = 3.0_mm;
  const double force = 0.7;
  const ContactPressure pressure(ParaboloidTip{ 10.0_mm }, 0.9_mm, a, force);
  const double peak = 3.0 * force / (2.0 * std::numbers::pi * a * a);
  for (const double fraction : { 0.0, 0.2, 0.5, 0.8, 0.95 })
  {
    EXPECT_NEAR(
      pressure.at(fraction * a), peak * std::sqrt(1.0 - fraction * fraction), 0.005 * peak);
  }
  EXPECT_EQ(pressure.at(1.01 * a), 0.0);
}

// p = F / (pi a^2) acosh(a / r)
TEST(ContactPressure, OfAConeIsLoves)
{
  const double a = 4.0_mm;
  const double force = 1.3;
  const ContactPressure pressure(ConeTip{ 45.0_deg, 10.0_mm }, 6.28_mm, a, force);
  const double mean = force / (std::numbers::pi * a * a);
  for (const double fraction : { 0.1, 0.3, 0.6, 0.9 })
  {
    EXPECT_NEAR(pressure.at(fraction * a), mean * std::acosh(1.0 / fraction), 0.01 * mean);
  }
}

// p = F / (2 pi a^2) / sqrt(1 - (r/a)^2)
TEST(ContactPressure, OfAFlatPunchIsBoussinesqs)
{
  const double a = 5.0_mm;
  const double force = 2.0;
  const ContactPressure pressure(PunchTip{ a }, 1.0_mm, a, force);
  const double middle = force / (2.0 * std::numbers::pi * a * a);
  for (const double fraction : { 0.0, 0.5, 0.9 })
  {
    const double expected = middle / std::sqrt(1.0 - fraction * fraction);
    EXPECT_NEAR(pressure.at(fraction * a), expected, 0.02 * expected);
  }
}

class AnyTip : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(ContactPressure, AnyTip,
  ::testing::Values(Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 30.0_deg, 6.0_mm } },
    Tip{ PunchTip{ 5.0_mm } }, Tip{ BluntConeTip{ 45.0_deg, 1.0_mm, 8.0_mm } },
    Tip{ TruncatedConeTip{ 60.0_deg, 2.0_mm, 8.0_mm } }));

TEST_P(AnyTip, AddsUpToTheForce)
{
  for (const double fraction : { 0.3, 0.7, 1.0 })
  {
    // the contact of a flat punch is always its base
    const bool isPunch = std::holds_alternative<PunchTip>(GetParam());
    const double a = (isPunch ? 1.0 : fraction) * baseRadius(GetParam());
    const ContactPressure pressure(GetParam(), 20.0_mm, a, 1.5);
    double sum = 0.0;
    constexpr int kRings = 20000;
    for (int i = 0; i < kRings; ++i)
    {
      const double radius = a * (i + 0.5) / kRings;
      sum += pressure.at(radius) * 2.0 * std::numbers::pi * radius * a / kRings;
    }
    EXPECT_NEAR(sum, 1.5, 0.01);
  }
}

TEST_P(AnyTip, IsFiniteAndNeverPulls)
{
  const double a = 0.6 * baseRadius(GetParam());
  const ContactPressure pressure(GetParam(), 10.0_mm, a, 1.0);
  for (double radius = 0.0; radius < 1.2 * a; radius += 0.01 * a)
  {
    EXPECT_TRUE(std::isfinite(pressure.at(radius)));
    EXPECT_GE(pressure.at(radius), 0.0);
  }
  EXPECT_EQ(ContactPressure(GetParam(), 10.0_mm, a, 0.0).at(0.0), 0.0);
}

} // namespace
} // namespace palp
