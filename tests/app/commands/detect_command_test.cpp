#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using test::Finished;

Finished palp(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " " + arguments);
}

std::vector<std::vector<std::string>> rowsOf(const std::string& text)
{
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    if (line.starts_with('#'))
    {
      continue;
    }
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');)
    {
      rows.back().push_back(cell);
    }
  }
  return rows;
}

constexpr double kDifferences[]{ 0.07, 0.15, 0.22, 0.45 };

// of what people compare, the third of compliance, which is one over the force of a depth
double difference(double factor, std::size_t column)
{
  return std::abs((column == 2 ? 1.0 / factor : factor) - 1.0);
}

// through the force of the same nodule, which palp force tells
TEST(DetectCommand, WhatItFindsDiffersByThatMuch)
{
  const std::string body = " --tip sphere:8mm --tissue healthy_liver --thickness 40mm ";
  for (const std::string ratio : { "7.7", "0.25" })
  {
    const Finished finished = palp("detect --depth 4mm --cover 3:9:3mm --ratio " + ratio + body);
    ASSERT_EQ(finished.code, 0) << finished.err;
    const auto rows = rowsOf(finished.out);
    ASSERT_EQ(rows.size(), 4U) << finished.out;
    EXPECT_EQ(rows[0][1], "diameter_at_7_percent_mm");
    for (std::size_t row = 1; row < rows.size(); ++row)
    {
      for (std::size_t i = 0; i < std::size(kDifferences); ++i)
      {
        if (rows[row][i + 1] == "-")
        {
          continue;
        }
        const double radius = 0.5 * std::stod(rows[row][i + 1]);
        const Finished felt = palp("force --law corrected --depth 4:4:1mm --nodule " +
          std::to_string(radius) + "mm:" + rows[row][0] + "mm:" + ratio + body);
        std::istringstream in(felt.out);
        const double factor = test::parseCsv(in)["factor_nodules"].at(0);
        EXPECT_NEAR(difference(factor, i), kDifferences[i], 0.005 * kDifferences[i])
          << rows[row][0] << ' ' << ratio;
      }
    }
  }
}

TEST(DetectCommand, DeeperAndSofterNodulesHaveToBeLarger)
{
  const auto rows = rowsOf(palp("detect").out);
  ASSERT_EQ(rows.size(), 11U); // 2 to 20 mm
  const auto soft = rowsOf(palp("detect --ratio 3").out);
  double before = 0.0;
  for (std::size_t row = 1; row < rows.size(); ++row)
  {
    const double diameter = std::stod(rows[row][1]);
    EXPECT_GT(diameter, before);
    EXPECT_GT(std::stod(soft[row][1]), diameter);
    before = diameter;
  }
}

TEST(DetectCommand, SaysWhatIsNotKnown)
{
  const Finished hardly = palp("detect --ratio 1.05 --cover 5:5:1mm --thickness 30mm");
  EXPECT_EQ(hardly.code, 0) << hardly.err;
  EXPECT_NE(hardly.out.find("\n5,-,-,-,-,-,-,-,-\n"), std::string::npos) << hardly.out;
  // 45 % more takes a ball whose added force large strain changes by more than 3 %
  const Finished strained = palp("detect --cover 4:4:1mm");
  EXPECT_NE(strained.out.find("nodule_strain"), std::string::npos) << strained.out;
  const Finished linear = palp("detect --cover 4:4:1mm --material linear");
  EXPECT_EQ(linear.out.find("nodule_strain"), std::string::npos) << linear.out;
  const Finished deep = palp("detect --depth 9mm --thickness 10mm --cover 2:2:1mm");
  EXPECT_NE(deep.err.find("outside its limits"), std::string::npos) << deep.err;
}

TEST(DetectCommand, KeepsTableAndChart)
{
  const test::TemporaryFolder folder;
  const std::string out = (folder.path() / "felt").string();
  const Finished finished = palp("detect --cover 2:10:4mm --out " + out);
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(test::readAll(folder.path() / "felt" / "detect.csv"), finished.out);
  EXPECT_EQ(test::readAll(folder.path() / "felt" / "detect.png").substr(1, 3), "PNG");
  EXPECT_EQ(palp("detect --out " + out).code, 2) << "would replace them";
}

TEST(DetectCommand, RefusesBadInputInOneSentence)
{
  const std::pair<const char*, const char*> refused[] = {
    { "--ratio 1", "as stiff as the tissue cannot be felt" }, { "--ratio 0", "give 0.2 to 50" },
    { "--ratio -3", "give 0.2 to 50" }, { "--ratio nan", "--ratio" }, { "--ratio 7kPa", "--ratio" },
    { "--cover 2:20", "--cover" }, { "--cover 2:20:2", "has no unit" },
    { "--cover 0:20:2mm", "give at most 1000 depths of 0.1mm to 1m" },
    { "--cover 1:2:0.0001mm", "give at most 1000 depths" },
    { "--cover 2:30:2mm --thickness 20mm", "30mm is below the base of the body" },
    { "--cover 19.9:19.9:1mm --thickness 20mm", "no nodule fits" }, { "--depth 0mm", "--depth" },
    { "--depth 5", "has no unit" }, { "--law paper", "only the corrected law knows nodules" },
    { "--tissue hc", "hcc" }, { "--tip egg:3mm", "--tip" },
    { "--coating 2mm:5kPa:0.4", "--coating" }
  };
  for (const auto& [arguments, sentence] : refused)
  {
    const Finished run = palp(std::string("detect ") + arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(test::sentences(run).size(), 1U) << run.err;
    EXPECT_NE(run.err.find(sentence), std::string::npos) << arguments << ": " << run.err;
  }
  const std::string help = palp("detect --help").out;
  EXPECT_NE(help.find("palp detect --tip"), std::string::npos);
  const std::string law = help.substr(help.find("--law TEXT"), 120); // and what it takes
  EXPECT_NE(law.find("corrected"), std::string::npos) << law;
  EXPECT_EQ(law.find("paper"), std::string::npos) << law;
  EXPECT_EQ(palp("detect --law corrected --cover 5:5:1mm").code, 0);
}

} // namespace
} // namespace palp
