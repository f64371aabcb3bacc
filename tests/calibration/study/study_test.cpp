#include "calibration/study/study.h"

#include "calibration/study/curve_fit.h"
#include "calibration/study/study_files.h"
#include "calibration/tables/extent_table.h"
#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/tip/profile.h"
#include "tests/calibration/indentation_case.h"
#include "tests/support/process.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace palp::fem
{
namespace
{

using namespace units::literals;

Case quick()
{
  Case study = paperCase();
  study.elementSize = 1.0_mm;
  study.depths = { 1.0_mm, 2.0_mm, 2.5_mm };
  return study;
}

std::string refusal(const Case& study)
{
  try
  {
    check(study);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    return error.what();
  }
  return {};
}

// into a folder, as the command does it
Outcome calibrateInto(const std::filesystem::path& folder, const Case& study, bool resume,
  std::stop_token stop = {}, const Progress& progress = {})
{
  OutputFolder output(folder, calibrationFiles(),
    resume ? OutputFolder::Earlier::Keep : OutputFolder::Earlier::Replace);
  return fem::calibrateInto(output, study, resume, stop, progress);
}

// the message of the error that resuming gives; empty when it goes on
std::string resumeRefusal(const std::filesystem::path& folder, const Case& study)
{
  try
  {
    (void)calibrateInto(folder, study, true);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadFile);
    return error.what();
  }
  return {};
}

TEST(Study, RefusesAbsurdGeometryBeforeAnyWork)
{
  EXPECT_EQ(refusal(quick()), "");
  Case study = quick();
  study.tip = SphereTip{ 60.0_mm };
  EXPECT_NE(refusal(study).find("--tip"), std::string::npos);
  study = quick();
  study.threshold = 3.0_mm;
  EXPECT_NE(refusal(study).find("--threshold"), std::string::npos);
  study = quick();
  study.depths.back() = 60.0_mm;
  EXPECT_NE(refusal(study).find("--depth"), std::string::npos);
  study = quick();
  study.material.poissonRatio = 0.5;
  EXPECT_NE(refusal(study).find("--poisson"), std::string::npos);
  study = quick();
  study.model = BodyModel::Block;
  study.length = 80.0_mm;
  EXPECT_NE(refusal(study).find("--model"), std::string::npos);
  study = quick();
  study.tip = withCap(ConeTip{ .halfAngle = 24.0_deg, .baseRadius = 10.0_mm }, 0.3_mm);
  EXPECT_NE(refusal(study).find("give 25 degrees or more"), std::string::npos);
  study.energy = Energy::Linear;
  EXPECT_EQ(refusal(study), "");
}

// elements wider than evenly spaced ones do not fill the block, but overshoot it
TEST(Study, RefusesElementsThatABlockCannotHold)
{
  Case study = quick();
  study.model = BodyModel::Block;
  study.elementSize = 100.0_mm / 29.0;
  EXPECT_EQ(refusal(study), "");
  study.elementSize *= 1.001;
  EXPECT_NE(refusal(study).find("--element-size"), std::string::npos);
  study.width = study.length = 10.0_mm;
  study.height = 100.0_mm;
  study.tip = SphereTip{ 4.0_mm };
  study.elementSize = 20.0_mm;
  EXPECT_NE(refusal(study).find("--element-size"), std::string::npos);
}

class BlockOf : public testing::TestWithParam<std::array<double, 4>>
{
};
INSTANTIATE_TEST_SUITE_P(Study, BlockOf,
  testing::Values(std::array{ 100.0_mm, 50.0_mm, 10.0_mm, 0.0 },
    std::array{ 100.0_mm, 50.0_mm, 44.0_mm, 0.0 }, std::array{ 100.0_mm, 4.0_mm, 44.0_mm, 0.0 },
    std::array{ 10.0_mm, 100.0_mm, 4.0_mm, 10.0_mm / 29.0 },
    std::array{ 100.0_mm, 5.0_mm, 10.0_mm, 1.0_mm },
    std::array{ 100.0_mm, 50.0_mm, 10.0_mm, 0.01_mm }));

TEST_P(BlockOf, HasTheSizeThatWasAskedFor)
{
  const auto [width, height, radius, elementSize] = GetParam();
  Case study = quick();
  study.model = BodyModel::Block;
  study.width = study.length = width;
  study.height = height;
  study.tip = SphereTip{ radius };
  study.elementSize = elementSize;
  ASSERT_EQ(refusal(study), "");
  const Body body = bodyOf(study);
  EXPECT_NEAR(body.positions.row(0).maxCoeff(), 0.5 * width, 1e-9 * width);
  EXPECT_NEAR(body.positions.row(1).maxCoeff(), 0.5 * width, 1e-9 * width);
  EXPECT_NEAR(body.positions.row(2).minCoeff(), 0.0, 1e-9 * height);
  EXPECT_NEAR(body.positions.row(2).maxCoeff(), height, 1e-9 * height);
}

TEST(Study, ExtentIsWhereTheDeformedSurfaceCrossesTheThreshold)
{
  const std::vector<IndentationStep::Point> profile{ { 0.0, 0.0, -3.0_mm },
    { 10.0_mm, 1.0_mm, -1.0_mm }, { 20.0_mm, 0.0, 0.0 } };
  EXPECT_DOUBLE_EQ(extentRadius(profile, 0.5_mm), 15.5_mm); // halfway from 11 to 20 mm
  EXPECT_EQ(extentRadius(profile, 3.0_mm), 0.0);
  EXPECT_DOUBLE_EQ(extentRadius({ profile[0], profile[1] }, 0.5_mm), 11.0_mm);
}

TEST(Study, AConeGetsATangentCap)
{
  const Tip capped = withCap(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm }, 0.3_mm);
  EXPECT_DOUBLE_EQ(std::get<BluntConeTip>(capped).tipRadius, 0.3_mm);
  EXPECT_TRUE(std::holds_alternative<SphereTip>(withCap(SphereTip{ 10.0_mm }, 0.3_mm)));
}

// the flank stays where it is, the flat loses what the edge takes: rounding tan(turn / 2)
TEST(Study, AFlatGetsARoundEdge)
{
  const Tip sharp = TruncatedConeTip{ 45.0_deg, 5.0_mm, 10.0_mm };
  const Tip round = withCap(sharp, 0.3_mm);
  EXPECT_NEAR(flatRadius(round), 5.0_mm - 0.3_mm * std::tan(22.5_deg), 1e-9);
  for (const double radius : { 6.0_mm, 8.0_mm, 10.0_mm })
  {
    EXPECT_NEAR(tipHeight(round, radius), tipHeight(sharp, radius), 1e-6);
  }
  EXPECT_NEAR(flatRadius(withCap(PunchTip{ 1.0_mm }, 0.3_mm)), 0.94_mm, 1e-9);
  EXPECT_TRUE(std::holds_alternative<PunchTip>(withCap(PunchTip{ 1.0_mm }, 0.0)));
}

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

TEST(Study, InterruptedAndResumedEqualsUninterrupted)
{
  const auto folder = test::freshFolder();
  std::stop_source source;
  const Outcome first = calibrateInto(folder, quick(), false, source.get_token(),
    [&](std::size_t done, std::size_t)
    {
      if (done == 2)
      {
        source.request_stop();
      }
    });
  EXPECT_EQ(first.steps.size(), 2U);
  EXPECT_NE(first.error, "");
  EXPECT_EQ(ExtentTable::read(folder / "table.csv").rows().size(), 2U); // usable as it is

  std::size_t computed = 0;
  const Outcome rest =
    calibrateInto(folder, quick(), true, {}, [&](std::size_t, std::size_t) { ++computed; });
  EXPECT_EQ(computed, 1U);
  const Outcome whole = calibrate(quick());
  ASSERT_EQ(rest.steps.size(), 3U);
  EXPECT_NEAR(rest.steps[2].force, whole.steps[2].force, 1e-6 * whole.steps[2].force);
  EXPECT_NEAR(rest.steps[0].force, whole.steps[0].force, 1e-9 * whole.steps[0].force);
  EXPECT_EQ(rest.steps[1].profile.size(), whole.steps[1].profile.size());
}

// three depths are as if nothing had happened
void expectWhole(const Outcome& outcome)
{
  static const Outcome kWhole = calibrate(quick());
  ASSERT_EQ(outcome.steps.size(), kWhole.steps.size());
  for (std::size_t i = 0; i < outcome.steps.size(); ++i)
  {
    const IndentationStep& step = outcome.steps[i];
    EXPECT_NEAR(step.depth, kWhole.steps[i].depth, 1e-9 * step.depth);
    EXPECT_NEAR(step.force, kWhole.steps[i].force, 1e-6 * step.force);
    EXPECT_EQ(step.profile.size(), kWhole.steps[i].profile.size());
  }
}

// the disk refuses a file, as if the program were killed before it
TEST(Study, ResumesFromBetweenAnyTwoFiles)
{
  for (const char* name : { "table.csv", "checkpoint.bin" })
  {
    const auto folder = test::freshFolder();
    const auto aside = folder.string() + "_aside";
    EXPECT_THROW((void)calibrateInto(folder, quick(), false, {},
                   [&](std::size_t done, std::size_t)
                   {
                     if (done == 2)
                     {
                       std::filesystem::rename(folder / name, aside);
                       std::filesystem::create_directory(folder / name);
                     }
                   }),
      Error)
      << name;
    std::filesystem::remove(folder / name);
    std::filesystem::rename(aside, folder / name);
    try
    {
      expectWhole(calibrateInto(folder, quick(), true));
    }
    catch (const Error& error)
    {
      ADD_FAILURE() << name << ": " << error.what();
    }
  }
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

TEST(Study, ResumeGoesOnToFurtherDepths)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 1.0_mm, 2.0_mm };
  (void)calibrateInto(folder, study, false);
  study.depths = { 2.0_mm, 2.5_mm };
  std::size_t computed = 0;
  expectWhole(
    calibrateInto(folder, study, true, {}, [&](std::size_t, std::size_t) { ++computed; }));
  EXPECT_EQ(computed, 1U);
  study.depths = { 1.0_mm, 2.0_mm };
  expectWhole(calibrateInto(folder, study, true)); // what is there stays
}

// nothing can be pressed less deep again
TEST(Study, ResumeRefusesADepthThatWasPassedAndLeavesTheTable)
{
  const auto folder = test::freshFolder();
  (void)calibrateInto(folder, quick(), false);
  Case study = quick();
  study.depths = { 0.6_mm, 1.0_mm, 1.5_mm, 2.52_mm };
  EXPECT_NE(resumeRefusal(folder, study).find("0.6 mm"), std::string::npos);
  const auto rows = ExtentTable::read(folder / "table.csv").rows();
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_DOUBLE_EQ(rows[0].depth, 1.0_mm);
}

Tip profileTip(double middle)
{
  return ProfileTip{ std::make_shared<const Profile>(
    std::vector<Profile::Point>{ { 0.0, 0.0 }, { 5.0_mm, middle }, { 10.0_mm, 5.0_mm } }) };
}

// all of one base, as a file of a tool that was edited is
TEST(Study, ResumeRefusesAnotherTool)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 1.0_mm };
  study.tip = profileTip(1.0_mm);
  (void)calibrateInto(folder, study, false);
  EXPECT_EQ(resumeRefusal(folder, study), "");
  for (const Tip& other : { profileTip(1.0_mm + 1e-9), profileTip(2.0_mm),
         Tip{ ParaboloidTip{ 10.0_mm } }, Tip{ PunchTip{ 10.0_mm } },
         Tip{ TruncatedConeTip{ 45.0_deg, 5.0_mm, 10.0_mm } }, Tip{ SphereTip{ 10.0_mm } } })
  {
    study.tip = other;
    EXPECT_NE(resumeRefusal(folder, study).find("another case"), std::string::npos);
  }
}

// and not only another one to the six digits that people read
TEST(Study, ResumeComparesEveryDigit)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 1.0_mm };
  (void)calibrateInto(folder, study, false);
  study.tip = SphereTip{ 10.0_mm + 1e-9 };
  EXPECT_NE(resumeRefusal(folder, study).find("another case"), std::string::npos);
  study = quick();
  study.depths = { 1.0_mm };
  study.material.poissonRatio += 1e-9;
  EXPECT_NE(resumeRefusal(folder, study).find("another case"), std::string::npos);
}

TEST(Study, ResumeRefusesOtherCoatings)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 1.0_mm };
  study.coatings.add({ 5.0_mm, { 10.0_kPa, 0.4 } });
  (void)calibrateInto(folder, study, false);
  EXPECT_EQ(resumeRefusal(folder, study), "");
  Case other = study;
  other.coatings = {};
  other.coatings.add({ 5.0_mm, { 10.0_kPa + 1e-6, 0.4 } });
  EXPECT_NE(resumeRefusal(folder, other).find("another case"), std::string::npos);
}

// deeper presses want fine elements further out: as many in all, elsewhere
TEST(Study, ResumeRefusesAnotherMesh)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 2.0_mm };
  const Body body = bodyOf(study);
  (void)calibrateInto(folder, study, false);
  study.depths = { 2.0_mm, 2.05_mm };
  while (bodyOf(study).positions == body.positions || bodyOf(study).nodeCount() != body.nodeCount())
  {
    study.depths.back() += 0.05_mm;
    ASSERT_LT(study.depths.back(), 9.0_mm);
  }
  ASSERT_EQ(bodyOf(study).nodeCount(), body.nodeCount());
  ASSERT_NE(bodyOf(study).positions, body.positions);
  EXPECT_NE(resumeRefusal(folder, study).find("another case"), std::string::npos);
}

// a table that an interrupted run of another case left beside an older checkpoint
TEST(Study, ResumeRefusesTheTableOfAnotherCase)
{
  const auto folder = test::freshFolder();
  const auto table = folder / "table.csv";
  Case study = quick();
  study.depths = { 1.0_mm };
  study.material.youngModulus = 40.0_kPa;
  (void)calibrateInto(folder, study, false);
  std::filesystem::rename(table, folder / "other.csv");
  study.material.youngModulus = 50.0_kPa;
  (void)calibrateInto(folder, study, false);
  std::filesystem::rename(folder / "other.csv", table);
  EXPECT_NE(resumeRefusal(folder, study), "");
}

TEST(Study, ResumeRefusesAnotherCaseAndADamagedFile)
{
  const auto folder = test::freshFolder();
  (void)calibrateInto(folder, quick(), false);
  Case other = quick();
  other.material.youngModulus = 40.0_kPa;
  EXPECT_THROW((void)calibrateInto(folder, other, true), Error);
  const auto file = folder / "checkpoint.bin";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 100);
  EXPECT_THROW((void)calibrateInto(folder, quick(), true), Error);
}

// one digit of either table, as an editor or a bad disk changes it
TEST(Study, ResumeRefusesAChangedNumber)
{
  for (const char* name : { "table.csv", "profiles.csv", "checkpoint.bin" })
  {
    const auto folder = test::freshFolder();
    (void)calibrateInto(folder, quick(), false);
    std::fstream file(folder / name, std::ios::in | std::ios::out | std::ios::binary);
    std::string content{ std::istreambuf_iterator<char>(file), {} };
    const auto at = static_cast<std::streamoff>(content.size() - 40);
    file.clear();
    file.seekp(at);
    file.put(content[static_cast<std::size_t>(at)] == '7' ? '8' : '7');
    file.close();
    EXPECT_NE(resumeRefusal(folder, quick()), "") << name;
  }
}

// a force that depends on the mesh is no result: what is kept changes by less than 1 % when the
// elements are halved
// 10 nm deep the contact is a hundredth of an element wide
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
    const double hertz =
      4.0 / 3.0 * study.material.contactModulus() * std::sqrt(radius) * std::pow(step.depth, 1.5);
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
  Indenter indenter(body, quick().tip, Energy::NeoHookean, quick().material);
  EXPECT_THROW(indenter.press(3.0_mm, source.get_token()), Error);
  EXPECT_EQ(indenter.checkpoint().depth, 0.0);
  indenter.press(3.0_mm);
  EXPECT_EQ(indenter.checkpoint().depth, 3.0_mm);
}

TEST(Study, SweepKeepsWhatWorksAndReportsWhatDoesNot)
{
  Case bad = quick();
  bad.name = "too large";
  bad.tip = SphereTip{ 60.0_mm };
  Case good = quick();
  good.name = "good";
  std::map<std::string, std::string> told;
  const auto folder = test::freshFolder();
  std::vector<std::unique_ptr<OutputFolder>> folders;
  for (const Case& study : { bad, good })
  {
    folders.push_back(std::make_unique<OutputFolder>(
      folder / study.name, calibrationFiles(), OutputFolder::Earlier::Refuse));
  }
  sweep(folders, { bad, good }, false, 2, {},
    [&](const std::string& name, const std::string& failure) { told[name] = failure; });
  EXPECT_NE(told.at("too large"), "");
  EXPECT_EQ(told.at("good"), "");
  EXPECT_EQ(ExtentTable::read(folder / "good" / "table.csv").rows().size(), 3U);
}

// a fit finds the polynomial that the points were taken from
TEST(Study, FitRecoversAParabola)
{
  const std::vector<double> x{ 1, 2, 3, 4, 5 };
  std::vector<double> y;
  for (const double value : x)
  {
    y.push_back(2.0 - 0.5 * value + 0.25 * value * value);
  }
  const Fit fit = fitPolynomial(x, y, 2);
  EXPECT_NEAR(fit.coefficients[0], 2.0, 1e-12);
  EXPECT_NEAR(fit.coefficients[1], -0.5, 1e-12);
  EXPECT_NEAR(fit.coefficients[2], 0.25, 1e-12);
  EXPECT_LT(fit.worst, 1e-12);
  EXPECT_TRUE(fitPolynomial({ 1.0 }, { 1.0 }, 1).coefficients.empty());
}

} // namespace
} // namespace palp::fem
