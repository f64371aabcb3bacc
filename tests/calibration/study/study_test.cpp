#include "calibration/study/study.h"

#include "calibration/tables/extent_table.h"
#include "haptics/files/number_table.h"
#include "tests/calibration/study/quick_case.h"

#include <fstream>
#include <map>
#include <sstream>

namespace palp::fem
{
namespace
{

using namespace units::literals;

TEST(Study, FilesSayWhatWasComputed)
{
  const auto folder = test::freshFolder();
  const Outcome outcome = calibrateInto(folder, quick(), false);
  const auto table = ExtentTable::read(folder / "table.csv");
  ASSERT_EQ(table.rows().size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(table.rows()[i].depth, outcome.steps[i].depth, 1e-12);
    EXPECT_NEAR(table.rows()[i].force, outcome.steps[i].force, 1e-10);
    EXPECT_NEAR(
      table.rows()[i].extentRadius, extentRadius(outcome.steps[i].profile, 0.5_mm), 1e-12);
  }
  std::ostringstream text;
  text << std::ifstream(folder / "table.csv").rdbuf();
  EXPECT_NE(text.str().find("W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2"), std::string::npos);
  EXPECT_EQ(
    NumberTable::read(folder / "profiles.csv", "depth_mm,radius_mm,ur_mm,uz_mm").rows.size(),
    3 * outcome.steps[0].profile.size());
  EXPECT_TRUE(std::filesystem::exists(folder / "fit.json"));
}

TEST(Study, AnEarlierCalibrationGoesWithTheFirstDepth)
{
  const auto folder = test::freshFolder();
  (void)calibrateInto(folder, quick(), false);
  std::ofstream(folder / "extent.png") << "of that one";
  std::stop_source source;
  source.request_stop();
  Case other = quick();
  other.material.youngModulus = 40.0_kPa;
  EXPECT_NE(calibrateInto(folder, other, false, source.get_token()).error, "");
  EXPECT_EQ(resumeRefusal(folder, quick()), ""); // what is there stays, before any depth
  EXPECT_TRUE(std::filesystem::exists(folder / "extent.png"));
  (void)calibrateInto(folder, other, false);
  EXPECT_EQ(resumeRefusal(folder, other), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "extent.png"));
}

// what is kept changes by less than 1 % when the elements are halved; 10 nm deep the contact is a
// hundredth of an element wide
TEST(Study, RefusesTheForcesThatDependOnTheMesh)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 10.0e-9, 2.0_mm };
  const Outcome outcome = calibrateInto(folder, study, false);
  ASSERT_EQ(outcome.refused, std::vector{ 10.0e-9 });
  EXPECT_NE(outcome.error.find("--element-size 0.5 mm"), std::string::npos) << outcome.error;
  ASSERT_EQ(outcome.steps.size(), 1U);
  EXPECT_EQ(resumeRefusal(folder, study), "");
}

// under a steep cone forces leap by 2 % from mesh to mesh, where two coarse ones agree
TEST(Study, KeepsNoRowUnderASteepConeThatAFinerMeshChanges)
{
  Case study{ .name = "steep",
    .width = 60.0_mm,
    .length = 60.0_mm,
    .height = 30.0_mm,
    .tip = withCap(ConeTip{ 30.0_deg, 8.0_mm }, 0.3_mm),
    .material = { 50.0_kPa, 0.49 },
    .depths = { 1.0_mm },
    .elementSize = 0.2_mm };
  const Outcome kept = calibrateInto(test::freshFolder(), study, false);
  study.elementSize = 0.1_mm;
  const Outcome finer = calibrate(study);
  ASSERT_EQ(finer.steps.size(), 1U);
  for (const IndentationStep& step : kept.steps)
  {
    EXPECT_NEAR(step.force, finer.steps[0].force, 0.01 * finer.steps[0].force);
  }
}

// the contact spans a few elements of the case: those rows come from smaller ones
TEST(Study, PressesShallowDepthsOnSmallerElements)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 0.1_mm, 0.5_mm, 2.5_mm };
  const Outcome outcome = calibrateInto(folder, study, false);
  EXPECT_EQ(outcome.error, "");
  ASSERT_EQ(outcome.steps.size(), 3U);
  // a sphere so shallow is Hertz's, on a layer of many contact radii
  for (const IndentationStep& step : { outcome.steps[0], outcome.steps[1] })
  {
    const double radius = baseRadius(study.tip);
    const double a = std::sqrt(radius * step.depth);
    const double hertz = hertzForce(study, radius, step.depth);
    const double chi = 1.41177 * a / study.height; // m0 of the bonded layer at nu = 0.33
    const double layer = 1.0 + 2.0 / M_PI * chi + 14.0 / (3.0 * M_PI * M_PI) * chi * chi;
    EXPECT_NEAR(step.force, layer * hertz, 0.02 * hertz) << step.depth;
  }
}

// also in the middle of a depth
TEST(Study, StopsWithinADepth)
{
  std::stop_source source;
  source.request_stop();
  const Body body = bodyOf(quick());
  Indenter indenter(body, quick().tip, StrainEnergy::NeoHookean, quick().material);
  EXPECT_THROW(indenter.press(3.0_mm, source.get_token()), Error);
  EXPECT_EQ(indenter.checkpoint().depth, 0.0);
  indenter.press(3.0_mm);
  EXPECT_EQ(indenter.checkpoint().depth, 3.0_mm);
}

} // namespace
} // namespace palp::fem
