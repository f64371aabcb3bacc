#include "tests/support/process.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp
{
namespace
{

using test::Finished;

Finished experiment(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " experiment " + arguments);
}

TEST(ExperimentCommand, WritesDataFindingAndEveryFigure)
{
  const test::TemporaryFolder folder;
  const Finished finished =
    experiment("inclination profiles --quick --out " + folder.path().string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_NE(finished.err.find("21.57 degrees by Eq. (7)"), std::string::npos);
  EXPECT_TRUE(test::readAll(folder.path() / "inclination.csv").starts_with("# Sphere: 21.57"));
  for (const char* name :
    { "inclination.png", "profiles.csv", "profiles_sphere.png", "profiles_cone.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "forces.csv"));

  const std::string again = "inclination --no-picture --out " + folder.path().string();
  EXPECT_EQ(experiment(again).code, 2);
  EXPECT_EQ(experiment(again + " --overwrite").code, 0);
}

// programs of others told the forces
TEST(ExperimentCommand, BodiesThatGiveWayAreFeltByTheirCells)
{
  const test::TemporaryFolder folder;
  const Finished finished = experiment("organ --quick --out " + folder.path().string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "organ.png"));
  std::istringstream lines(test::readAll(folder.path() / "organ.csv"));
  std::string line;
  std::getline(lines, line); // what was found
  std::getline(lines, line);
  EXPECT_EQ(
    line, "method,setting,regime,solve_s,place_ms,time_s,answer_us,error_max_pct,error_rms_pct");
  int count = 0;
  while (std::getline(lines, line))
  {
    SCOPED_TRACE(line);
    ++count;
    const double worst = std::abs(std::stod(line.substr(line.rfind(',', line.rfind(',') - 1) + 1)));
    const bool isSolved = line.find("cells of 6 mm") != std::string::npos;
    if (isSolved && line.find("lobe") != std::string::npos)
    {
      EXPECT_LT(worst, 10.0);
    }
    // 2 mm from the edge, too
    if (isSolved && line.find("block") != std::string::npos)
    {
      EXPECT_LT(worst, 20.0);
    }
    if (line.starts_with("no organ file") && line.find("lobe") != std::string::npos)
    {
      EXPECT_GT(worst, 50.0);
    }
  }
  EXPECT_EQ(count, 3 * 10); // two sizes of cells and none
}

// before the work, whichever of its files is there
TEST(ExperimentCommand, ReplacesAPictureOnlyWhenAsked)
{
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "profiles_cone.png") << "mine";
  const Finished refused = experiment("profiles --no-picture --out " + folder.path().string());
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("holds profiles_cone.png"), std::string::npos) << refused.err;
  EXPECT_EQ(test::readAll(folder.path() / "profiles_cone.png"), "mine");
}

TEST(ExperimentCommand, RefusesAnUnknownNameAndAFolderThatCannotBe)
{
  const test::TemporaryFolder folder;
  const Finished unknown = experiment("gravity");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("inclination"), std::string::npos) << unknown.err; // what there is
  const Finished blocked = experiment("inclination --no-picture --out /dev/null/experiments");
  EXPECT_EQ(blocked.code, 2);
  EXPECT_NE(blocked.err.find("/dev/null/experiments"), std::string::npos) << blocked.err;
}

} // namespace
} // namespace palp
