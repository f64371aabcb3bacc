#include "tests/support/process.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace palp
{
namespace
{

test::Finished bench(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " bench " + arguments);
}

// what it says, not how fast it is
TEST(BenchCommand, PrintsOnlyJsonAndComparesWithIt)
{
  const test::Finished first = bench("--json --most 1600");
  ASSERT_EQ(first.code, 0) << first.err;
  nlohmann::json report = nlohmann::json::parse(first.out);
  const double sweep = report.at("S_us");
  EXPECT_GT(sweep, 0.0);
  EXPECT_FALSE(report.at("machine").get<std::string>().empty());
  std::set<std::string> works;
  std::set<std::string> cases;
  for (const nlohmann::json& row : report.at("rows"))
  {
    works.insert(row.at("work"));
    cases.insert(row.at("case"));
    const double median = row.at("median_us");
    EXPECT_GT(median, 0.0);
    EXPECT_LE(median, row.at("p99_us"));
    EXPECT_GT(row.at("mean_us"), 0.0);
    EXPECT_GE(row.at("sd_us"), 0.0);
    EXPECT_NEAR(row.at("per_S"), median / sweep, 1e-9 * median);
  }
  EXPECT_EQ(works,
    (std::set<std::string>{
      "law", "memory", "query_brute", "servo_step", "tree_build", "update" }));
  EXPECT_EQ(cases, (std::set<std::string>{ "cold", "jump", "moving", "paced" }));

  // against figures a thousand times as large, and as small
  for (const auto& [factor, code] : { std::pair(1e3, 0), std::pair(1e-3, 2) })
  {
    nlohmann::json recorded = report;
    for (nlohmann::json& row : recorded.at("rows"))
    {
      row["per_S"] = factor * row.at("per_S").get<double>();
    }
    const auto file = test::freshFolder() / "gate.json";
    std::ofstream(file) << recorded;
    EXPECT_EQ(bench("--json --most 1600 --gate " + file.string()).code, code);
  }
}

TEST(BenchCommand, PutsSpringsAndElementsBesideOurs)
{
  const test::Finished finished = bench("--json --baselines");
  ASSERT_EQ(finished.code, 0) << finished.err;
  std::set<std::string> names;
  const nlohmann::json report = nlohmann::json::parse(finished.out);
  for (const nlohmann::json& row : report.at("rows"))
  {
    EXPECT_EQ(row.at("vertices"), 1600);
    EXPECT_GT(row.at("median_us"), 0.0);
    names.insert(row.value("variant", row.at("work").get<std::string>()));
  }
  EXPECT_EQ(names,
    (std::set<std::string>{
      "corotational", "mass-spring", "mass-spring-volume", "servo_step", "update" }));
}

TEST(BenchCommand, MeasuresPicturesByTheProgramThatDrawsThem)
{
  const test::Finished finished = bench("--frames --quick --json --most 1600");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const nlohmann::json rows = nlohmann::json::parse(finished.out).at("rows");
  ASSERT_GT(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("case"), "still");
  EXPECT_EQ(rows[1].at("case"), "500");
  for (std::size_t i = 2; i < rows.size(); ++i)
  {
    EXPECT_EQ(rows[i].at("work"), "overlay");
  }
}

TEST(BenchCommand, MeasuresSweepsInAFolderOfItsOwn)
{
  const auto folder = test::freshFolder();
  const std::string sweep = "--cases 100 --quick --sweep " + (folder / "new").string();
  const test::Finished finished = bench(sweep);
  ASSERT_EQ(finished.code, 0) << finished.err;
  for (const char* figure : { "ms a case", "times as fast", "plan of 100 cases: ", "status: ",
         "merge into all.csv: ", "merge into all.vtt: ", "most entries in a folder: " })
  {
    EXPECT_NE(finished.out.find(figure), std::string::npos) << figure << finished.out;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "new"));
  std::filesystem::create_directory(folder / "new"); // of somebody else
  EXPECT_EQ(bench(sweep).code, 2);
  EXPECT_TRUE(std::filesystem::exists(folder / "new"));
}

TEST(BenchCommand, RefusesAGateThatIsNoReport)
{
  const auto file = test::freshFolder() / "gate.json";
  std::ofstream(file) << "no report";
  const test::Finished finished = bench("--most 0 --gate " + file.string());
  EXPECT_EQ(finished.code, 2);
  EXPECT_NE(finished.err.find("gate.json"), std::string::npos);
}

TEST(BenchCommand, RefusesWhatIsNoTimeAndNoNumber)
{
  for (const char* arguments :
    { "--servo -5s", "--servo 0s", "--servo 1e300s", "--most -5", "--slack nan --most 0",
      "--slack 0.5", "--servo 1s --processor 1023", "--servo 1s --processor -1" })
  {
    const test::Finished finished = bench(arguments);
    EXPECT_EQ(finished.code, 2) << arguments;
    EXPECT_EQ(finished.out, "") << arguments;
  }
}

} // namespace
} // namespace palp
