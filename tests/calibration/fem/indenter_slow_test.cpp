#include "tests/calibration/indentation_case.h"

namespace palp::fem
{
namespace
{

using test::referenceTable;

// the paper's 30 x 30 x 10 nodes against the fine meshes of an independent program
struct Compared
{
  const char* reference;
  StrainEnergy energy;
  double radius;
  double height;
  double deepest;
};

class SlowBlock : public testing::TestWithParam<Compared>
{
};
INSTANTIATE_TEST_SUITE_P(Block, SlowBlock,
  testing::Values(
    Compared{ "fig15_sphere_R6__NH_h0.25", StrainEnergy::NeoHookean, 6.0_mm, 30.0_mm, 6.0_mm },
    Compared{ "fig15_sphere_R6__COROT_h1", StrainEnergy::Corotated, 6.0_mm, 30.0_mm, 6.0_mm },
    Compared{ "fig15_sphere_R6__LINS_h0.25", StrainEnergy::Linear, 6.0_mm, 30.0_mm, 6.0_mm },
    Compared{ "calib_sphere_R10__NH_h0.5", StrainEnergy::NeoHookean, 10.0_mm, 50.0_mm, 10.0_mm },
    Compared{ "calib_sphere_R10__COROT_h1", StrainEnergy::Corotated, 10.0_mm, 50.0_mm, 10.0_mm },
    Compared{ "calib_sphere_R10__LINS_h0.25", StrainEnergy::Linear, 10.0_mm, 50.0_mm, 10.0_mm }));

TEST_P(SlowBlock, ForceIsWithinEightPercentFromOneMillimeterOn)
{
  const Compared& what = GetParam();
  const Case study{ .name = "block",
    .height = what.height,
    .tip = SphereTip{ what.radius },
    .energy = what.energy,
    .depths = depthRange(1.0_mm, what.deepest, 1.0_mm),
    .model = BodyModel::Block };
  const auto rows = referenceTable(what.reference);
  double worstForce = 0.0;
  double worstExtent = 0.0;
  for (const IndentationStep& step : completed(study).steps)
  {
    const auto& row = rows.at(static_cast<std::size_t>(std::lround(step.depth / 0.5_mm)) - 1);
    ASSERT_NEAR(row.number("delta_m"), step.depth, 1e-9);
    const double force = row.number("F_N");
    EXPECT_NEAR(step.force, force, 0.08 * force) << step.depth;
    EXPECT_NEAR(step.baseReaction, step.force, 1e-4 * step.force);
    EXPECT_LE(step.penetration, 1e-3 * step.depth);
    const double extent = row.number("Rd05_def_m");
    const double found = extentRadius(step.profile, study.threshold);
    EXPECT_NEAR(found, extent, std::max(0.3_mm, 0.06 * extent)) << step.depth;
    worstForce = std::max(worstForce, std::abs(step.force / force - 1.0));
    worstExtent = std::max(worstExtent, std::abs(found - extent));
  }
  RecordProperty("worst_force_percent", std::to_string(100.0 * worstForce));
  RecordProperty("worst_extent_mm", std::to_string(units::toMillimeters(worstExtent)));
}

// from where the contact spans four elements
TEST(SlowIndenter, HalvingTheMeshUnderTheConeChangesTheForceByLessThanTwoPercent)
{
  Case coarse = paperCase();
  coarse.tip = cappedCone();
  coarse.elementSize = 0.5_mm;
  Case fine = coarse;
  fine.elementSize = 0.25_mm;
  const auto before = completed(coarse).steps;
  const auto after = completed(fine).steps;
  double worst = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_NEAR(before[i].force, after[i].force, 0.02 * after[i].force) << before[i].depth;
    worst = std::max(worst, std::abs(before[i].force / after[i].force - 1.0));
  }
  RecordProperty("worst_force_percent", std::to_string(100.0 * worst));
}

} // namespace
} // namespace palp::fem
