#include "calibration/experiments/experiments.h"

#include <gtest/gtest.h>

namespace palp::fem
{
namespace
{

double at(const Experiment& experiment, std::size_t row, const std::string& column)
{
  return experiment.numbers.column(column)[row];
}

void expectFull(const Experiment& experiment)
{
  EXPECT_FALSE(experiment.numbers.rows.empty());
  for (const auto& row : experiment.numbers.rows)
  {
    EXPECT_EQ(row.size(), experiment.numbers.columns.size());
  }
  EXPECT_FALSE(experiment.figures.empty());
  for (const Figure& figure : experiment.figures)
  {
    EXPECT_FALSE(figure.curves.empty()) << figure.name;
  }
  testing::Test::RecordProperty("finding", experiment.finding);
}

// independent program: 5.98 N at 10 mm
TEST(SlowExperiments, CurvatureReproducesTheLargestForceOfFigureThree)
{
  const Experiment found = curvature(Resolution::Full);
  expectFull(found);
  EXPECT_NEAR(at(found, 9, "sphere_block_N"), 5.98, 0.05 * 5.98);
  // softer where it is held on a cap only
  EXPECT_LT(
    at(found, 4, "sphere_R0_30mm_cap_percent"), at(found, 4, "sphere_R0_30mm_half_percent"));
}

// independent program, R = 6 mm: 2.278 N neo-Hookean and 1.770 N corotated at 5 mm
TEST(SlowExperiments, PapersLawLiesBetweenCorotatedAndNeoHookean)
{
  const Experiment found = forces(Resolution::Full);
  expectFull(found);
  EXPECT_NEAR(at(found, 9, "sphere_neo-hookean_N"), 2.278, 0.03 * 2.278);
  EXPECT_NEAR(at(found, 9, "sphere_corotated_N"), 1.770, 0.05 * 1.770);
  EXPECT_GT(at(found, 11, "sphere_paper_N"), at(found, 11, "sphere_corotated_N"));
  EXPECT_LT(at(found, 11, "sphere_paper_N"), at(found, 11, "sphere_neo-hookean_N"));
}

// independent program: 30.4 and 22.5 mm at 10 mm
TEST(SlowExperiments, ExtentDoesNotFeelYoungsModulus)
{
  const Experiment found = extents(Resolution::Full);
  expectFull(found);
  EXPECT_NEAR(at(found, 19, "sphere_50kPa_mm"), 30.4, 0.06 * 30.4);
  EXPECT_NEAR(at(found, 19, "cone_50kPa_mm"), 22.5, 0.06 * 22.5);
  EXPECT_NEAR(at(found, 19, "sphere_1500kPa_mm"), at(found, 19, "sphere_50kPa_mm"), 1e-4);
}

TEST(SlowExperiments, ProfilesCompareBothCurves)
{
  expectFull(profiles(Resolution::Full));
}

} // namespace
} // namespace palp::fem
