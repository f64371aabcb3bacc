#include "calibration/tables/extent_table.h"
#include "haptics/tip/profile.h"
#include "tests/calibration/study/quick_case.h"

#include <fstream>

namespace palp::fem
{
namespace
{

using namespace units::literals;

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

// the case is named like its folder, which may be copied or renamed
TEST(Study, ResumeGoesOnInACopyOfTheFolder)
{
  const auto folder = test::freshFolder();
  Case study = quick();
  study.depths = { 1.0_mm };
  (void)calibrateInto(folder, study, false);
  study.name = "copy";
  EXPECT_EQ(resumeRefusal(folder, study), "");
  std::filesystem::resize_file(folder / "checkpoint.bin", 200);
  EXPECT_NE(resumeRefusal(folder, study).find("cut off"), std::string::npos);
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

} // namespace
} // namespace palp::fem
