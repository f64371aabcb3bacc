#include "haptics/files/number_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::Finished;

std::vector<NumberTable::Row> rowsOf(const std::filesystem::path& table)
{
  return NumberTable::read(table, "depth_mm,extent_radius_mm,force_N,contact_radius_mm").rows;
}

Finished calibrate(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " calibrate --element-size 1mm " + arguments);
}

TEST(CalibrateCommand, WritesATableThatFollowsHertzWithinTheBlocksStiffening)
{
  const auto folder = test::freshFolder();
  const Finished finished = calibrate("--material linear --depth 1:3:1mm --out " + folder.string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto rows = rowsOf(folder / "table.csv");
  ASSERT_EQ(rows.size(), 3U);
  for (const auto& [row, line] : rows)
  {
    const double hertz = 4.0 / 3.0 * 50e3 / (1 - 0.33 * 0.33) * 0.1 * std::pow(row[0] / 1e3, 1.5);
    EXPECT_GT(row[2], 0.95 * hertz);
    EXPECT_LT(row[2], 1.15 * hertz);
  }
  for (const char* name : { "profiles.csv", "fit.json" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name));
  }
}

TEST(CalibrateCommand, InterruptedLeavesATableThatResumeCompletes)
{
  const auto folder = test::freshFolder();
  const std::string command =
    PALP_PROGRAM " calibrate --no-picture --element-size 0.5mm --out " + folder.string();
  const std::string table = (folder / "table.csv").string();
  const Finished stopped = test::runCommand(command + " & running=$!; until [ -s " + table +
    " ]; do sleep 0.02; done; kill -INT $running; wait $running");
  EXPECT_EQ(stopped.code, 5);
  EXPECT_NE(stopped.err.find("--resume goes on from here"), std::string::npos) << stopped.err;
  const auto before = rowsOf(table);
  ASSERT_GE(before.size(), 1U);
  ASSERT_LT(before.size(), 20U);

  const Finished resumed = test::runCommand(command + " --resume");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  const auto after = rowsOf(table);
  ASSERT_EQ(after.size(), 20U);
  EXPECT_EQ(after[0].values, before[0].values);
}

TEST(CalibrateCommand, SweepRefusesAFolderThatCannotBeBeforeTheWork)
{
  const auto folder = test::freshFolder();
  std::ofstream(folder / "second") << "a file where the second case wants its folder";
  std::ofstream(folder / "cases.json") << R"([
    {"name": "good", "young": "5kPa", "depth": "1:2:1mm"},
    {"name": "second", "depth": "1:2:1mm"}])";
  const std::string sweep =
    "--sweep " + (folder / "cases.json").string() + " --out " + folder.string();
  const Finished blocked = calibrate(sweep);
  EXPECT_EQ(blocked.code, 2);
  EXPECT_NE(blocked.err.find("second: cannot be written"), std::string::npos) << blocked.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "good"));

  std::filesystem::remove(folder / "second");
  const Finished finished = calibrate(sweep);
  EXPECT_EQ(finished.code, 0);
  EXPECT_NE(finished.err.find("good: done"), std::string::npos);
  EXPECT_EQ(rowsOf(folder / "good" / "table.csv").size(), 2U);
  for (const char* name : { "extent.png", "force.png", "profiles.png" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / "good" / name)) << name;
  }
}

TEST(CalibrateCommand, ReplacesAnEarlierCalibrationOnlyWhenAsked)
{
  const auto folder = test::freshFolder();
  const std::string command = "--no-picture --depth 1:2:1mm --out " + folder.string();
  ASSERT_EQ(calibrate(command).code, 0);
  const std::string before = test::readAll(folder / "table.csv");
  const Finished refused = calibrate(command + " --young 5kPa");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  EXPECT_EQ(test::readAll(folder / "table.csv"), before);
  const Finished replaced = calibrate(command + " --young 5kPa --overwrite");
  EXPECT_EQ(replaced.code, 0);
  EXPECT_NE(replaced.err.find("will replace"), std::string::npos) << replaced.err;
  EXPECT_NE(test::readAll(folder / "table.csv"), before);
}

TEST(CalibrateCommand, SaysHowLargeAToolAndAThresholdMayBe)
{
  EXPECT_NE(calibrate("--tip sphere:60mm").err.find("below 45 mm"), std::string::npos);
  EXPECT_NE(calibrate("--threshold 12mm").err.find("less than the deepest depth of 10 mm"),
    std::string::npos);
}

// also where a factorization of minutes has no place to ask
TEST(CalibrateCommand, EndsSoonAfterATermInTheMiddleOfADepth)
{
  const auto folder = test::freshFolder();
  const Finished stopped = test::runCommand("timeout -k 20 -s TERM 1 " PALP_PROGRAM
                                            " calibrate --no-picture --element-size 0.05mm --out " +
    folder.string() + "; code=$?; [ $code = 124 ] || exit $code");
  EXPECT_EQ(stopped.code, 0); // by the TERM, not by the KILL 20 s later, which is 137
  EXPECT_NE(stopped.err.find("interrupted before the first depth"), std::string::npos)
    << stopped.err;
  EXPECT_EQ(stopped.err.find("--resume"), std::string::npos) << stopped.err;
}

TEST(CalibrateCommand, SweepsStayBelowOutAndSayWhatIsWrong)
{
  const auto folder = test::freshFolder();
  const auto file = folder / "sweep.json";
  for (const char* bad :
    { "{}", "[]", "null", "[3]", "[{", "3", R"([{"name": "../../esc"}])",
      R"([{"name": "/tmp/esc"}])", R"([{"name": ".."}])", R"([{"name": ""}])", R"([{"name": 3}])",
      R"([{"young": "5kPa"}])", R"([{"name": "a", "depth": 3}])", R"([{"name": "a", "size": "3"}])",
      R"([{"name": "a"}, {"name": "a"}])", R"([{"name": "a", "young": "5kPa", "young": "9kPa"}])",
      R"([{"name": "a", "young": 1e999}])" })
  {
    std::ofstream(file) << bad;
    const Finished finished =
      calibrate("--sweep " + file.string() + " --out " + (folder / "out").string());
    EXPECT_EQ(finished.code, 2) << bad;
    EXPECT_EQ(finished.err.find("exception"), std::string::npos) << finished.err;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << bad;
  }
}

TEST(CalibrateCommand, ManyJobsAreNoMoreThanTheCases)
{
  const auto folder = test::freshFolder();
  const auto file = folder / "sweep.json";
  std::ofstream(file) << R"([{"name": "a", "depth": "1:1:1mm", "threshold": "0.2mm"}])";
  const Finished finished = calibrate(
    "--no-picture --jobs 99999 --sweep " + file.string() + " --out " + (folder / "out").string());
  EXPECT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(rowsOf(folder / "out" / "a" / "table.csv").size(), 1U);
}

TEST(CalibrateCommand, RefusesBadInputInOneLine)
{
  for (const char* bad :
    { "--tip sphere:60mm", "--threshold 12mm", "--threshold 10mm", "--block 100x100mm",
      "--block 100x100x50", "--material rubber", "--poisson 0.5", "--depth 0:90:1mm",
      "--model cube", "--tip punch:6mm --cap 0mm",
      "--tip truncated-cone:30deg:2mm:8mm --cap 0.01mm", "--sweep /no/such/file.json", "--jobs 2",
      "--sweep /no/such/file.json --jobs 0", "--tables /no/such/folder --tip sphere:3mm" })
  {
    const Finished finished = calibrate(bad);
    EXPECT_EQ(finished.code, 2) << bad;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

} // namespace
} // namespace palp
