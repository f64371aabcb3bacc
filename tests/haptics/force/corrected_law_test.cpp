#include "haptics/force/force_law.h"

#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/haptics/force/tips.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/shipped_ratios.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;

const Material kTissue{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };

// made up, to see that the law applies it: 1 + 0.1 depth/R, and 1.05 for every cone
LargeStrainTable madeUpRatios()
{
  return std::make_shared<const LargeStrain>(
    LargeStrain{ { { 0.0, 1.0, 2.0 }, { 0.0 }, { 0.33 }, { 1.0, 1.1, 1.2 } },
      { { 0.0, 1.0 }, { 0.5, 1.1 }, { 0.33 }, { 1.05, 1.05, 1.05, 1.05 } } });
}

struct Factored
{
  const char* table;
  Tip tip;
  double thickness;
};

class BondedLayer : public ::testing::TestWithParam<Factored>
{
};
INSTANTIATE_TEST_SUITE_P(CorrectedLaw, BondedLayer,
  ::testing::Values(Factored{ "analytic_sphere_R6_H30", SphereTip{ 6.0_mm }, 30.0_mm },
    Factored{ "analytic_sphere_R10_H50", SphereTip{ 10.0_mm }, 50.0_mm },
    Factored{ "analytic_cone45_H30", ConeTip{ 45.0_deg, 50.0_mm }, 30.0_mm },
    Factored{ "analytic_cone45_H50", ConeTip{ 45.0_deg, 50.0_mm }, 50.0_mm },
    Factored{ "analytic_cone45_rho0.3_H30", BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm }, 30.0_mm },
    Factored{ "analytic_cone45_rho0.3_H50", BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm }, 50.0_mm }));

// the tables carry eight digits
TEST_P(BondedLayer, AgreesWithTheIntegralEquation)
{
  const auto rows = test::referenceTable(GetParam().table);
  ASSERT_GE(rows.size(), 16U);
  const ForceLaw law(GetParam().tip, kTissue, { .mode = LawMode::Corrected });
  double worst = 0.0;
  for (const auto& row : rows)
  {
    const double force =
      law({ .depth = row.number("delta_m"), .thickness = GetParam().thickness }).force;
    const double error = std::abs(force / row.number("F_layer_N") - 1.0);
    EXPECT_LE(error, 1e-5) << row.number("delta_m");
    worst = std::max(worst, error);
  }
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
}

class AnyTipCorrected : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(CorrectedLaw, AnyTipCorrected, ::testing::ValuesIn(test::allTips()));

TEST_P(AnyTipCorrected, IsExactWhereNothingActs)
{
  const ForceLaw corrected(GetParam(), kTissue, { .mode = LawMode::Corrected });
  const ForceLaw exact(GetParam(), kTissue, { .mode = LawMode::Exact });
  EXPECT_EQ(corrected({ .depth = 3.0_mm }).force, exact({ .depth = 3.0_mm }).force);
}

TEST_P(AnyTipCorrected, FactorsMultiplyThePapersForce)
{
  const ContactGeometry position{ .depth = 3.0_mm,
    .tilt = 9.0_deg,
    .thickness = 20.0_mm,
    .surfaceCurvature = 1.0 / 50.0_mm,
    .curvatureSpread = 1.0 / 100.0_mm };
  const ForceLaw law(
    GetParam(), kTissue, { .mode = LawMode::Corrected, .largeStrain = madeUpRatios() });
  double force = ForceLaw(GetParam(), kTissue)(position).force;
  for (const Factor& factor : law.factors(position))
  {
    EXPECT_GT(factor.value, 0.0) << factor.name;
    force *= factor.value;
  }
  EXPECT_NEAR(law(position).force, force, 1e-12 * force);
}

TEST_P(AnyTipCorrected, EachFactorCanBeSwitchedOff)
{
  const ContactGeometry position{
    .depth = 3.0_mm, .tilt = 9.0_deg, .thickness = 20.0_mm, .surfaceCurvature = 1.0 / 50.0_mm
  };
  const ForceLaw law(GetParam(), kTissue,
    { .mode = LawMode::Corrected,
      .constitution = ConstitutiveModel::Linear,
      .largeStrain = madeUpRatios(),
      .curvature = false,
      .thickness = false,
      .inclination = false });
  const ForceLaw exact(GetParam(), kTissue, { .mode = LawMode::Exact });
  EXPECT_EQ(law(position).force, exact(position).force);
}

TEST_P(AnyTipCorrected, StiffnessIsTheDerivativeWithEveryFactor)
{
  // the table of a profile rounds its corners
  const double tolerance = std::holds_alternative<ProfileTip>(GetParam()) ? 1e-2 : 2e-4;
  const ForceLaw law(
    GetParam(), kTissue, { .mode = LawMode::Corrected, .largeStrain = madeUpRatios() });
  const auto at = [&law](double depth)
  {
    return law({ .depth = depth,
      .tilt = 9.0_deg,
      .thickness = 30.0_mm,
      .surfaceCurvature = 1.0 / 50.0_mm,
      .curvatureSpread = 1.0 / 100.0_mm });
  };
  double force = 0.0;
  for (double depth = 1e-6; depth < 30.0_mm; depth *= 1.1)
  {
    const double h = 1e-4 * depth;
    const double numeric = (at(depth + h).force - at(depth - h).force) / (2.0 * h);
    EXPECT_NEAR(at(depth).stiffness, numeric, tolerance * numeric) << depth;
    EXPECT_GT(at(depth).force, force);
    force = at(depth).force;
  }
}

TEST_P(AnyTipCorrected, ReturnsNoNaN)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const ForceLaw law(
    GetParam(), kTissue, { .mode = LawMode::Corrected, .largeStrain = madeUpRatios() });
  for (const double odd : { nan, infinite, -infinite, 0.0, -1.0, 1e-300, 1e300 })
  {
    for (const ContactGeometry& position : { ContactGeometry{ .depth = odd, .thickness = 10.0_mm },
           ContactGeometry{ .depth = 1.0_mm, .tilt = odd },
           ContactGeometry{ .depth = 1.0_mm, .thickness = odd },
           ContactGeometry{ .depth = 1.0_mm, .surfaceCurvature = odd },
           ContactGeometry{ .depth = 1.0_mm, .curvatureSpread = odd } })
    {
      const Response response = law(position);
      EXPECT_TRUE(std::isfinite(response.force) && response.force >= 0.0) << odd;
      EXPECT_TRUE(std::isfinite(response.stiffness) && response.stiffness >= 0.0) << odd;
      EXPECT_TRUE(std::isfinite(response.contactRadius)) << odd;
      for (const Factor& factor : law.factors(position))
      {
        EXPECT_TRUE(std::isfinite(factor.value)) << factor.name << " " << odd;
      }
    }
  }
}

TEST(CorrectedLaw, AppliesTheRatioOfLargeStrain)
{
  const LawSettings settings{ .mode = LawMode::Corrected, .largeStrain = madeUpRatios() };
  const ForceLaw sphere(SphereTip{ 10.0_mm }, kTissue, settings);
  EXPECT_NEAR(sphere.largeStrain({ .depth = 5.0_mm }).value, 1.05, 1e-12);
  EXPECT_TRUE(sphere.largeStrain({ .depth = 5.0_mm }).inside);
  EXPECT_FALSE(sphere.largeStrain({ .depth = 25.0_mm }).inside);
  const ForceLaw cone(ConeTip{ 45.0_deg, 10.0_mm }, kTissue, settings);
  EXPECT_NEAR(cone.largeStrain({ .depth = 5.0_mm, .thickness = 30.0_mm }).value, 1.05, 1e-12);
  const ForceLaw blunt(PunchTip{ 10.0_mm }, { 5.0_kPa, 0.2 }, settings);
  EXPECT_TRUE(blunt.largeStrain({ .depth = 5.0_mm }).inside);
  EXPECT_FALSE(blunt.largeStrain({ .depth = 16.1_mm }).inside);
  EXPECT_FALSE(
    ForceLaw(PunchTip{ 10.0_mm }, kTissue, settings).largeStrain({ .depth = 5.0_mm }).inside);
}

// what the shipped tables say they cover, as `palp calibrate --tables` presses it
TEST(CorrectedLaw, OutsideItsTablesLargeStrainIsFlaggedForAnyPoissonsRatio)
{
  const LawSettings settings{ .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() };
  const auto isFlagged = [&](const Tip& tip, double nu)
  {
    const Validity validity(ForceLaw(tip, { 50.0_kPa, nu }, settings));
    const Rules rules = validity({ .depth = 8.0_mm, .thickness = 50.0_mm });
    return !std::ranges::find(rules, std::string("large_strain"), &Rule::name)->holds();
  };
  for (int hundredths = 0; hundredths <= 50; ++hundredths)
  {
    const double nu = hundredths / 100.0;
    EXPECT_EQ(isFlagged(SphereTip{ 10.0_mm }, nu), hundredths > 49) << nu;
    for (const double angle : { 45.0_deg, 50.0_deg, 60.0_deg, 62.0_deg, 80.0_deg })
    {
      EXPECT_FALSE(isFlagged(ConeTip{ angle, 10.0_mm }, nu)) << nu << " " << angle;
    }
    EXPECT_TRUE(isFlagged(ConeTip{ 38.0_deg, 10.0_mm }, nu)) << nu;
  }
}

class NeoHookeanBlock : public ::testing::TestWithParam<Factored>
{
};
INSTANTIATE_TEST_SUITE_P(CorrectedLaw, NeoHookeanBlock,
  ::testing::Values(Factored{ "fig15_sphere_R6__NH_h0.25", SphereTip{ 6.0_mm }, 30.0_mm },
    Factored{ "calib_sphere_R10__NH_h0.5", SphereTip{ 10.0_mm }, 50.0_mm },
    Factored{ "fig15_cone45__NH_h0.25", BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm }, 30.0_mm },
    Factored{ "calib_cone45__NH_h0.25", BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm }, 50.0_mm },
    Factored{ "calib_cone45__NH_h0.5", BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm }, 50.0_mm }));

// Another program's finite elements on a block, from 1 mm to the tool's radius. The sphere's ratios
// are computed by our own; the cone's stem from these runs and the linear ones on the same meshes,
// so that for the cone it is tested that one curve serves both blocks on top of the exact layer.
TEST_P(NeoHookeanBlock, IsMetWithin3PercentWherePapersLawIsOffBy10)
{
  const auto rows = test::referenceTable(GetParam().table);
  ASSERT_GE(rows.size(), 13U);
  const ForceLaw corrected(
    GetParam().tip, kTissue, { .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() });
  const ForceLaw paper(GetParam().tip, kTissue);
  double worst = 0.0;
  double worstPaper = 0.0;
  for (const auto& row : rows)
  {
    const ContactGeometry position{ .depth = row.number("delta_m"),
      .thickness = GetParam().thickness };
    const bool compared = position.depth > 0.99_mm && position.depth < 10.01_mm &&
      (std::holds_alternative<BluntConeTip>(GetParam().tip) ||
        position.depth < baseRadius(GetParam().tip) * 1.001);
    if (compared)
    {
      const double force = row.number("F_N");
      worst = std::max(worst, std::abs(corrected(position).force / force - 1.0));
      worstPaper = std::max(worstPaper, std::abs(paper(position).force / force - 1.0));
    }
  }
  EXPECT_LE(worst, 0.03);
  EXPECT_GE(worstPaper, 0.09);
  RecordProperty("worst_percent", std::to_string(100.0 * worst));
  RecordProperty("worst_of_paper_percent", std::to_string(100.0 * worstPaper));
}

// linear finite elements on a ball of 100 mm that is glued below, far from the tool
TEST(CorrectedLaw, CurvedSurfaceIsThatOfFiniteElements)
{
  struct Ball
  {
    const char* table;
    Tip tip;
  };
  for (const Ball& ball :
    { Ball{ "fig3_sphere_R10_on_elastic_sphere_R0_100_cap45__LINS_h1", SphereTip{ 10.0_mm } },
      Ball{ "fig3_cone45_on_elastic_sphere_R0_100_cap45__LINS_h0.5",
        BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm } } })
  {
    const auto rows = test::referenceTable(ball.table);
    ASSERT_GE(rows.size(), 10U);
    const ForceLaw law(ball.tip, kTissue, { .mode = LawMode::Corrected });
    for (const auto& row : rows)
    {
      const double depth = row.number("delta_m");
      const double force = row.number("F_N");
      EXPECT_NEAR(
        law({ .depth = depth, .surfaceCurvature = 1.0 / 100.0_mm }).force, force, 0.015 * force)
        << ball.table << " " << depth;
    }
  }
}

// Balls held on their lower half, and balls glued on their foot: the program knows neither, only a
// convex surface over a thickness of two radii. Within 5 % of finite elements, or flagged.
TEST(CorrectedLaw, ABallIsThatOfFiniteElementsHoweverItIsHeldOrFlagged)
{
  const std::string angle = "cone45_on_elastic_sphere_R0_";
  const std::string round = "sphere_R10_on_elastic_sphere_R0_";
  int believed = 0;
  for (const bool cone : { false, true })
  {
    for (const ConstitutiveModel tissue :
      { ConstitutiveModel::Linear, ConstitutiveModel::NeoHookean })
    {
      const Tip tip =
        cone ? Tip{ BluntConeTip{ 45.0_deg, 0.3_mm, 20.0_mm } } : SphereTip{ 10.0_mm };
      const ForceLaw law(tip, kTissue,
        { .mode = LawMode::Corrected,
          .constitution = tissue,
          .largeStrain = test::shippedRatios() });
      const Validity validity(law);
      for (const int ball : { 30, 100 })
      {
        for (const std::string support : { "_cap45__", "_hemi__" })
        {
          const std::string name = "fig3_" + (cone ? angle : round) + std::to_string(ball) +
            support + (tissue == ConstitutiveModel::Linear ? "LINS" : "NH") +
            (cone ? "_h0.5" : "_h1");
          const auto rows = test::referenceTable(name);
          ASSERT_EQ(rows.size(), 10U) << name;
          for (const auto& row : rows)
          {
            const ContactGeometry position{ .depth = row.number("delta_m"),
              .thickness = 2.0 * units::fromMillimeters(ball),
              .surfaceCurvature = 1.0 / units::fromMillimeters(ball) };
            if (brokenRules(validity(position)) == 0)
            {
              EXPECT_NEAR(law(position).force / row.number("F_N"), 1.0, 0.05)
                << name << " " << position.depth;
              ++believed;
            }
          }
        }
      }
    }
  }
  EXPECT_GE(believed, 70); // of 160
}

TEST(CorrectedLaw, DoesNotAllocate)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kTissue,
    { .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() });
  const Validity validity(law);
  const ContactGeometry position{ .depth = 3.0_mm,
    .tilt = 9.0_deg,
    .thickness = 20.0_mm,
    .surfaceCurvature = 1.0 / 50.0_mm,
    .curvatureSpread = 1.0 / 100.0_mm };
  const test::AllocationGuard guard;
  const double force = law(position).force;
  const double factor = law.factors(position)[3].value;
  const double value = validity(position)[0].value;
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(force + factor + value, 0.0);
}

TEST(CorrectedLaw, WithoutATableLargeStrainIsLinear)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kTissue, { .mode = LawMode::Corrected });
  EXPECT_EQ(law.largeStrain({ .depth = 5.0_mm }).value, 1.0);
  EXPECT_FALSE(law.largeStrain({ .depth = 5.0_mm }).inside);
}

} // namespace
} // namespace palp
