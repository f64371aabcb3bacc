#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace palp
{
namespace
{

test::Finished stability(const std::string& arguments)
{
  return test::runCommand(PALP_PROGRAM " stability " + arguments);
}

using Row = std::vector<std::string>; // the cells of a line

Row cells(const std::string& line)
{
  Row row;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');)
  {
    row.push_back(cell);
  }
  line.ends_with(',') ? row.emplace_back() : row.back();
  return row;
}

enum Column
{
  Case,
  Young,
  Poisson,
  Tool,
  Period,
  Chain,
  Outcome,
  LimitedBy,
  PeakForce,
  Hum,
  StrainEnergy,
  Mass, // empty but of an arm
};

// one study for all that is claimed of it, since it takes seconds
struct Study
{
  std::string header;
  std::vector<Row> rows;
};

Study read(const std::filesystem::path& file)
{
  Study study;
  std::istringstream text(test::readAll(file));
  std::getline(text, study.header);
  for (std::string line; std::getline(text, line);)
  {
    study.rows.push_back(cells(line));
  }
  return study;
}

void expectKnownColumns(const Study& study)
{
  EXPECT_EQ(study.header,
    "case,young_Pa,poisson,tool,period_ms,chain,outcome,limited_by,peak_force_N,limit_cycle_speed_"
    "m_per_s,energy_uJ,mass_kg,damping_N_s_per_m,friction_N,encoder_step_um,delay_ms,stated_delay_"
    "ms,hand_stiffness_N_per_m,hand_damping_N_s_per_m");
  ASSERT_GT(study.rows.size(), 100u);
  std::map<std::string, int> walls;
  for (const Row& row : study.rows)
  {
    ASSERT_EQ(row.size(), 19u) << row[Case];
    EXPECT_TRUE(row[Chain] == "on" || row[Chain] == "off");
    walls[row[Chain]] += row[Young] == "inf" ? 1 : 0;
  }
  EXPECT_GT(walls["on"], 0);
  EXPECT_EQ(walls["on"], walls["off"]);
}

// what the words mean, from the numbers beside them
void expectWordsToFitTheNumbers(const Study& study)
{
  constexpr double kMostGiven = 50e3; // [uJ], by a delay that is told wrong
  for (const Row& row : study.rows)
  {
    if (!row[Mass].empty()) // which may swing a while, see StabilityLimits
    {
      const bool isGood = row[Outcome] != "unstable" && std::stod(row[StrainEnergy]) > -kMostGiven;
      EXPECT_TRUE(row[Chain] == "off" || row[Outcome] == "refused" || isGood) << row[Case];
      continue;
    }
    const bool breaks = std::stod(row[StrainEnergy]) < -1.0 || std::stod(row[Hum]) > 0.025;
    EXPECT_TRUE(!breaks || row[Outcome] == "unstable") << row[Case];
    EXPECT_TRUE(row[Outcome] != "stable" || row[LimitedBy] == "none") << row[Case];
    EXPECT_TRUE(row[Outcome] != "limited" || row[LimitedBy] != "none") << row[Case];
    if (row[Chain] == "on")
    {
      EXPECT_NE(row[Outcome], "unstable") << row[Case];
      EXPECT_LE(std::stod(row[PeakForce]), 4.0 * (1.0 + 1e-9)) << row[Case];
    }
    else
    {
      EXPECT_EQ(row[LimitedBy], "none") << row[Case];
      EXPECT_TRUE(row[Young] != "inf" || row[Outcome] == "unstable") << row[Case];
    }
  }
}

TEST(StabilityCommand, TellsTheSameInColumnsInWordsAndAsAPicture)
{
  const test::TemporaryFolder folder;
  const test::Finished finished = stability("--quick --out " + folder.path().string());
  ASSERT_EQ(finished.code, 0) << finished.err;
  const Study study = read(folder.path() / "stability.csv");
  expectKnownColumns(study);
  expectWordsToFitTheNumbers(study);
  const auto unstable = std::ranges::count_if(
    study.rows, [](const Row& row) { return row[Chain] == "off" && row[Outcome] == "unstable"; });
  const std::string sentence = "Of " + std::to_string(study.rows.size() / 2) +
    " situations from 1 kPa to a rigid wall, " + std::to_string(unstable) + " are unstable when";
  EXPECT_NE(finished.out.find(sentence), std::string::npos) << finished.out;
  EXPECT_EQ(test::readAll(folder.path() / "stability.svg").find("<svg"), 0u);
}

TEST(StabilityCommand, LeavesTheStudyBeforeUntilItsEnd)
{
  const test::TemporaryFolder folder;
  const auto table = folder.path() / "stability.csv";
  std::ofstream(table) << "of the study before";
  const std::string out = " --out " + folder.path().string();
  EXPECT_EQ(stability("--quick" + out).code, 2); // without --overwrite
  const test::Finished ended =
    test::runCommand("timeout -s INT 0.5 " PALP_PROGRAM " stability --overwrite" + out);
  EXPECT_EQ(ended.code, 124) << ended.err;
  EXPECT_EQ(test::readAll(table), "of the study before");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(StabilityCommand, RefusesAPlaceWhereItCannotWrite)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "file"; // not a directory
  std::ofstream(file) << "x";
  const test::Finished finished = stability("--quick --out " + file.string());
  EXPECT_EQ(finished.code, 2);
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_NE(stability("").code, 0); // no --out
}

TEST(DevicesCommand, TellsEachKindAndRefusesWhatIsNoDevice)
{
  const test::Finished listed = test::runCommand(PALP_PROGRAM " devices");
  const bool usable =
    std::regex_search(listed.out, std::regex("\n  [^\n]*: can be used|spacenavd runs"));
  const bool found = std::regex_search(listed.out, std::regex("\n  [^\n]* at /"));
  EXPECT_EQ(listed.code, usable ? 0 : found ? 6 : 3) << listed.out;
  for (const char* kind :
    { "SpaceMouse (", "Novint Falcon (", "raw HID boards (", "Haply Inverse3 (" })
  {
    EXPECT_NE(listed.out.find(kind), std::string::npos) << listed.out;
  }
  EXPECT_NE(listed.out.find("none yet on hardware"), std::string::npos) << listed.out;
  const std::pair<const char*, int> refused[] = { { "nothing", 2 }, { "wooden", 2 },
    { "phd1:/dev/nowhere", 3 }, { "phd1:/dev/null", 3 },
    { "wooden:/dev/nowhere,/nowhere.conf", 2 } };
  for (const auto& [name, code] : refused)
  {
    const test::Finished finished =
      test::runCommand(std::string(PALP_PROGRAM " devices --probe ") + name);
    EXPECT_EQ(finished.code, code) << name;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

} // namespace
} // namespace palp
