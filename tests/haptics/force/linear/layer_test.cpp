#include "haptics/force/linear/layer.h"

#include "haptics/force/linear/layer_contact.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/haptics/force/tips.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kEndless = std::numeric_limits<double>::infinity();

Tip tipOf(const test::ReferenceRow& row)
{
  const std::string shape = row.text("shape");
  const double first = row.number("p1_m_or_rad");
  constexpr double base = 20.0_mm;
  if (shape == "paraboloid")
  {
    return ParaboloidTip{ first };
  }
  if (shape == "sphere" || shape == "sphere_on_curved")
  {
    return SphereTip{ first };
  }
  if (shape == "cone" || shape == "cone_on_curved")
  {
    return ConeTip{ first, base };
  }
  const double second = row.number("p2_m");
  if (shape == "trunc_cone")
  {
    return TruncatedConeTip{ first, second, base };
  }
  return BluntConeTip{ first, second, base };
}

// the same integral equation solved with sixty points for each contact
TEST(LayerContact, AgreesWithTheIntegralEquation)
{
  const auto rows = test::referenceTable("layer_equation");
  ASSERT_GE(rows.size(), 600U);
  double worst = 0.0;
  double worstWide = 0.0;
  for (const auto& row : rows)
  {
    const double nu = row.number("nu");
    const double thickness = row.number("thickness_m");
    const bool curved = row.text("shape").find("on_curved") != std::string::npos;
    const LayerContact law(tipOf(row), nu, row.number("bonded") != 0.0 ? Base::Bonded : Base::Slip);
    const LinearContact contact =
      law(row.number("delta_m"), thickness, curved ? 1.0 / row.number("p2_m") : 0.0);
    const double force = 50.0_kPa / (1.0 - nu * nu) * contact.force;
    const double error = std::abs(force / row.number("F_N") - 1.0);
    const double width = row.number("a_m") / thickness;
    EXPECT_LE(error, 1e-5) << row.text("shape") << " nu " << nu << " a/h " << width;
    EXPECT_NEAR(contact.radius / row.number("a_m"), 1.0, 1e-3);
    (width <= 0.601 ? worst : worstWide) = std::max(width <= 0.601 ? worst : worstWide, error);
  }
  RecordProperty("worst_to_0.6", std::to_string(worst * 1e6) + "e-6");
  RecordProperty("worst_to_1", std::to_string(worstWide * 1e6) + "e-6");
}

// m0 = int_0^inf (1 - L) dx, from the first order of phi: c_0 = 1 + (2/pi) m0 a/h
TEST(Layer, FirstOrderIsThatOfTheSeries)
{
  struct Case
  {
    double nu;
    Base base;
    double m0;
  };
  for (const Case& c : { Case{ 0.0, Base::Bonded, 1.21106 }, Case{ 0.33, Base::Bonded, 1.41177 },
         Case{ 0.45, Base::Bonded, 1.62547 }, Case{ 0.5, Base::Bonded, 1.77022 },
         Case{ 0.0, Base::Slip, 1.16758 }, Case{ 0.5, Base::Slip, 1.16758 } })
  {
    const Layer layer(c.nu, c.base);
    EXPECT_NEAR(layer(0.0).slope[0] * std::numbers::pi / 2.0, c.m0, 2e-4 * c.m0) << c.nu;
  }
}

// the series in chi = sqrt(R d) / h, to its own accuracy
TEST(LayerContact, AgreesWithTheSeriesForAParaboloid)
{
  constexpr double pi = std::numbers::pi;
  constexpr double m0 = 1.77022;
  constexpr double m2 = 3.83108;
  constexpr double radius = 10.0_mm;
  const LayerContact law(ParaboloidTip{ radius }, 0.5, Base::Bonded);
  for (const double chi : { 0.02, 0.05, 0.1, 0.2, 0.3 })
  {
    const double depth = 1.0_mm;
    const double c = 4.0 * m0 / (3.0 * pi);
    const double series = 1.0 + 2.0 / pi * m0 * chi + 14.0 / (3.0 * pi * pi) * m0 * m0 * chi * chi +
      (5.0 * c * c * c - 8.0 / (15.0 * pi) * m2) * chi * chi * chi +
      (10.0546875 * c * c * c * c - 16.0 / (5.0 * pi * pi) * m0 * m2) * std::pow(chi, 4);
    const double hertz = 4.0 / 3.0 * std::sqrt(radius) * std::pow(depth, 1.5);
    EXPECT_NEAR(law(depth, std::sqrt(radius * depth) / chi, 0.0).force / hertz, series,
      2e-5 + 4.0 * std::pow(chi, 5));
  }
}

// Garcia and Garcia 2018, cone, nu = 0.5: 1 + 0.721 c + 0.650 c^2 + 0.491 c^3 + 0.225 c^4
TEST(LayerContact, AgreesWithThePublishedSeriesForACone)
{
  const LayerContact law(ConeTip{ 45.0_deg, 20.0_mm }, 0.5, Base::Bonded);
  for (const double c : { 0.05, 0.1, 0.2, 0.4 })
  {
    const double depth = 4.0_mm;
    const double series =
      1.0 + 0.721 * c + 0.650 * c * c + 0.491 * c * c * c + 0.225 * c * c * c * c;
    EXPECT_NEAR(
      law(depth, depth / c, 0.0).force / (2.0 / std::numbers::pi * depth * depth), series, 1.5e-3);
  }
}

class AnyTipOnALayer : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(LayerContact, AnyTipOnALayer, ::testing::ValuesIn(test::allTips()));

TEST_P(AnyTipOnALayer, ThickLayerIsTheHalfSpace)
{
  const LayerContact layer(GetParam(), 0.33, Base::Bonded);
  const HalfSpace halfSpace(GetParam());
  for (double depth = 0.01_mm; depth < 20.0_mm; depth *= 1.5)
  {
    const double force = halfSpace(depth).force;
    EXPECT_NEAR(layer(depth, kEndless, 0.0).force, force, 1e-6 * force);
    EXPECT_NEAR(layer(depth, 1e4, 0.0).force, force, 1e-5 * force);
  }
}

TEST_P(AnyTipOnALayer, ThinnerIsStifferAndBondedStifferThanSlipping)
{
  const LayerContact bonded(GetParam(), 0.45, Base::Bonded);
  const LayerContact slip(GetParam(), 0.45, Base::Slip);
  double force = 0.0;
  for (const double thickness : { 1.0, 50.0_mm, 20.0_mm, 10.0_mm, 5.0_mm, 2.0_mm, 1.0_mm })
  {
    const double now = bonded(3.0_mm, thickness, 0.0).force;
    EXPECT_GT(now, force);
    EXPECT_GT(now, slip(3.0_mm, thickness, 0.0).force);
    force = now;
  }
}

// monotone and smooth for all thicknesses and curvatures, far thinner than the theory reaches
// included; the tolerance is that of a corner in the profile, which the table rounds
TEST_P(AnyTipOnALayer, StiffnessIsTheDerivativeOfTheForce)
{
  for (const double nu : { 0.0, 0.33, 0.5 })
  {
    const LayerContact law(GetParam(), nu, Base::Bonded);
    for (const double thickness : { 1.0_mm, 5.0_mm, 20.0_mm, 100.0_mm, kEndless })
    {
      for (const double curvature : { -1.0 / 25.0_mm, 0.0, 1.0 / 30.0_mm, 1.0 / 5.0_mm })
      {
        double stiffness = 0.0;
        for (double depth = 1e-6; depth < 40.0_mm; depth *= 1.13)
        {
          const double h = 1e-4 * depth;
          const double numeric = (law(depth + h, thickness, curvature).force -
                                   law(depth - h, thickness, curvature).force) /
            (2.0 * h);
          const double now = law(depth, thickness, curvature).stiffness;
          ASSERT_NEAR(now, numeric, 1e-2 * numeric)
            << "nu " << nu << " h " << thickness << " 1/R0 " << curvature << " depth " << depth;
          ASSERT_GE(now, stiffness * (1.0 - 1e-6));
          stiffness = now;
        }
      }
    }
  }
}

TEST_P(AnyTipOnALayer, CurvatureFadesAsTheSurfaceFlattens)
{
  const LayerContact law(GetParam(), 0.33, Base::Bonded);
  const double flat = law(2.0_mm, kEndless, 0.0).force;
  EXPECT_NEAR(law(2.0_mm, kEndless, 1e-6).force, flat, 1e-7 * flat);
  if (flatRadius(GetParam()) == 0.0)
  {
    EXPECT_LT(law(2.0_mm, kEndless, 1.0 / 50.0_mm).force, flat);
    EXPECT_GT(law(2.0_mm, kEndless, -1.0 / 50.0_mm).force, flat);
  }
}

// Hertz: a sphere R on a sphere R0 is a paraboloid of R R0 / (R + R0)
TEST(LayerContact, ParaboloidOnASphereIsHertz)
{
  const LayerContact law(ParaboloidTip{ 10.0_mm }, 0.33, Base::Bonded);
  for (const double other : { 30.0_mm, 100.0_mm, -30.0_mm })
  {
    const double reduced = 10.0_mm * other / (10.0_mm + other);
    const double hertz = 4.0 / 3.0 * std::sqrt(reduced) * std::pow(2.0_mm, 1.5);
    EXPECT_NEAR(law(2.0_mm, kEndless, 1.0 / other).force, hertz, 1e-6 * hertz);
  }
}

// d = (pi/2) a cot(alpha) + a^2/R0, F = 2 E* ((pi/4) a^2 cot(alpha) + 2 a^3 / (3 R0))
TEST(LayerContact, ConeOnASphereIsItsClosedForm)
{
  const LayerContact law(ConeTip{ 30.0_deg, 20.0_mm }, 0.33, Base::Bonded);
  const double cot = 1.0 / std::tan(30.0_deg);
  for (const double a : { 0.5_mm, 2.0_mm, 5.0_mm })
  {
    const double depth = std::numbers::pi / 2.0 * a * cot + a * a / 50.0_mm;
    const double force =
      2.0 * (std::numbers::pi / 4.0 * a * a * cot + 2.0 * a * a * a / (3.0 * 50.0_mm));
    EXPECT_NEAR(law(depth, kEndless, 1.0 / 50.0_mm).force, force, 1e-6 * force);
  }
}

// half of depth / a^2 is least where the contact reaches the step: pi / 4 * 0.1 mm / (5 mm)^2
TEST(LayerContact, AHollowSurfaceIsNoMoreHollowThanAStepOfTheTip)
{
  const Tip stepped = ProfileTip{ std::make_shared<const Profile>(
    std::vector<Profile::Point>{ { 0.0, 0.0 }, { 5.0_mm, 0.1_mm }, { 6.0_mm, 50.0_mm } }) };
  const LayerContact law(stepped, 0.33, Base::Bonded);
  const double step = std::numbers::pi / 2.0 * 0.1_mm / (5.0_mm * 5.0_mm);
  EXPECT_GE(law.allowedCurvature(-100.0), -0.6 * step * (1.0 + 1e-9));
  EXPECT_LE(law.allowedCurvature(-100.0), -0.98 * 0.6 * step);
  EXPECT_EQ(law.allowedCurvature(-0.49 * step), -0.49 * step); // as it is to half of that
  double before = 0.0;
  for (int i = 1; i <= 500; ++i)
  {
    const double force = law(i * 0.002_mm, kEndless, -100.0).force;
    EXPECT_GT(force, before) << i * 0.002 << " mm";
    before = force;
  }
}

// the force aside is what the energy changes by as the curvature does: a corner would be a step
TEST(LayerContact, HasNoCornerHoweverHollowTheSurface)
{
  constexpr double kStep = 0.002; // of the curvature that the tool has
  for (const Tip& tip : { Tip(SphereTip{ 10.0_mm }), Tip(ParaboloidTip{ 10.0_mm }),
         Tip(BluntConeTip{ 45.0_deg, 2.0_mm, 8.0_mm }), Tip(ConeTip{ 45.0_deg, 10.0_mm }) })
  {
    const LayerContact law(tip, 0.33, Base::Bonded);
    for (const double thickness : { 25.0_mm, kEndless })
    {
      const auto force = [&](double bent)
      { return law(3.0_mm, thickness, bent / baseRadius(tip)).force; };
      for (double bent = -1.5; bent < 0.3; bent += kStep)
      {
        const double before = force(bent - kStep) - force(bent - 2.0 * kStep);
        const double after = force(bent + kStep) - force(bent);
        EXPECT_LT(std::abs(after - before), 0.0002 * force(bent))
          << tip.index() << " " << bent << " " << thickness;
      }
    }
  }
}

} // namespace
} // namespace palp
