#include "haptics/files/number_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

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

// the base that the block stands on, against the series of Lebedev and Ufliand for a layer on each
TEST(CalibrateCommand, ABaseThatSlipsIsAsMuchSofterAsTheLayerSays)
{
  const auto calibrated = [](const std::string& base)
  {
    const auto folder = test::freshFolder();
    const Finished finished = calibrate("--no-picture --material linear --depth 1:2:1mm --base " +
      base + " --out " + folder.string());
    EXPECT_EQ(finished.code, 0) << finished.err;
    return rowsOf(folder / "table.csv").at(1).values[2];
  };
  const auto ofLaw = [](const std::string& base)
  {
    const Finished finished = test::runCommand(PALP_PROGRAM
      " force --law corrected --thickness 50mm --material linear --depth 2:2:1mm --base " +
      base);
    EXPECT_EQ(finished.code, 0) << finished.err;
    std::istringstream lines(finished.out);
    double force = 0.0;
    for (std::string line; std::getline(lines, line);)
    {
      if (const auto comma = line.find(','); std::isdigit(line[0]) != 0)
      {
        force = std::stod(line.substr(comma + 1));
      }
    }
    return force;
  };
  const double softer = calibrated("slip") / calibrated("bonded");
  EXPECT_LT(softer, 0.99);
  EXPECT_NEAR(softer, ofLaw("slip") / ofLaw("bonded"), 0.01);
  EXPECT_EQ(calibrate("--base loose --out nowhere").code, 2);
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

// a sphere three quarters into a layer: what was reached is kept
TEST(CalibrateCommand, EndsWithFiveWhereNoSurfaceFollowsTheTool)
{
  const auto folder = test::freshFolder();
  const Finished finished = test::runCommand(PALP_PROGRAM
    " calibrate --no-picture --tip sphere:10mm --block 60x60x20mm --element-size 2mm "
    "--depth 8:15.5:7.5mm --out " +
    folder.string());
  EXPECT_EQ(finished.code, 5) << finished.err;
  EXPECT_NE(finished.err.find("1 of 2 depths are in"), std::string::npos) << finished.err;
  EXPECT_EQ(rowsOf(folder / "table.csv").size(), 1U);
}

// rows A to D of data/reference/maps_axisym.csv, other elements; borders between two tissues lie
// within elements here
TEST(CalibrateCommand, FollowsAMapOfStiffness)
{
  struct Map
  {
    std::string formula;
    std::vector<double> forces; // at 2 and 4 mm [N]
    double error;
  };
  for (const Map& map :
    { Map{ "50", { 0.825835, 2.39986 }, 0.002 }, Map{ "50*(1+z/20)", { 1.11988, 3.43424 }, 0.002 },
      Map{ "if(r<6,100,50)", { 1.22661, 3.20861 }, 0.01 },
      Map{ "if(z>10,150,50)", { 1.0588, 3.36806 }, 0.015 },
      Map{ "if(z<2,150,50)", { 0.937734, 2.60541 }, 0.015 } })
  {
    const auto folder = test::freshFolder();
    const Finished finished =
      test::runCommand(PALP_PROGRAM " calibrate --block 200x200x40mm --poisson 0.45 --material "
                                    "linear --depth 2:4:2mm --no-picture"
                                    " --stiffness 'formula:" +
        map.formula + "' --out " + folder.string());
    ASSERT_EQ(finished.code, 0) << finished.err;
    const auto rows = rowsOf(folder / "table.csv");
    ASSERT_EQ(rows.size(), map.forces.size());
    for (std::size_t i = 0; i < map.forces.size(); ++i)
    {
      EXPECT_NEAR(rows[i].values[2], map.forces[i], map.error * map.forces[i]) << map.formula;
    }
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
TEST(CalibrateCommand, TellsHowFarItIsAndEndsSoonAfterATermInTheMiddleOfADepth)
{
  const auto folder = test::freshFolder();
  const std::string told = (folder / "told").string();
  const Finished stopped =
    test::runCommand(PALP_PROGRAM " calibrate --no-picture --element-size 0.05mm --out " +
      (folder / "out").string() + " 2> " + told + " & running=$!; until [ -s " + told +
      " ]; do sleep 0.05; done; used=$(awk '{print int(($14 + $15) / 100)}' /proc/$running/stat); "
      "prlimit --pid $running "
      "--cpu=$((used + 2)); kill -TERM $running; wait $running; code=$?; cat " +
      told + " >&2; exit $code");
  EXPECT_EQ(stopped.code, 5); // by itself, not by the limit of 2 s of a processor more
  EXPECT_TRUE(stopped.err.starts_with("palp: 0 of 20 depths done, ")) << stopped.err;
  EXPECT_NE(stopped.err.find("interrupted before the first depth"), std::string::npos)
    << stopped.err;
  EXPECT_EQ(stopped.err.find("--resume"), std::string::npos) << stopped.err;
}

TEST(CalibrateCommand, SweepMakesTheTablesOfItsCasesAndKeepsThem)
{
  const auto folder = test::freshFolder();
  std::ofstream(folder / "sweep.json") << R"({"palp_sweep": 1, "kind": "calibrate", "fixed":
    {"depth": "1:2:1mm", "element-size": "1mm"}, "grid": {"young": ["5kPa", "20kPa"]}})";
  const std::string out = (folder / "out").string();
  const std::string sweep =
    PALP_PROGRAM " calibrate --sweep " + (folder / "sweep.json").string() + " --out " + out;
  const Finished first = test::runCommand(sweep + " --jobs 2");
  ASSERT_EQ(first.code, 0) << first.err;
  const Finished again = test::runCommand(sweep);
  EXPECT_NE(again.err.find("0 cases computed, 2 finished"), std::string::npos) << again.err;

  const auto table = [](const std::filesystem::path& file) // without the line that names the case
  {
    const std::string text = test::readAll(file);
    return text.substr(text.find('\n'));
  };
  std::set<std::string> tables;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out + "/results"))
  {
    if (entry.path().filename() == "table.csv")
    {
      tables.insert(table(entry.path()));
    }
  }
  std::set<std::string> alone;
  for (const std::string young : { "5kPa", "20kPa" })
  {
    const std::string one = (folder / young).string();
    ASSERT_EQ(calibrate("--no-picture --depth 1:2:1mm --young " + young + " --out " + one).code, 0);
    alone.insert(table(one + "/table.csv"));
  }
  EXPECT_EQ(tables, alone);
}

// of a block of 100 x 100 x 50 mm in elements of 0.5 mm
TEST(CalibrateCommand, SaysWhyANoduleDoesNotFitTheBlock)
{
  const auto refused = [](const std::string& nodule)
  { return test::runCommand(PALP_PROGRAM " calibrate --no-picture --nodule " + nodule).err; };
  EXPECT_EQ(refused("60mm:5mm:5"),
    "palp: --nodule: it reaches from 5 mm to 125 mm deep and is 120 mm wide, and this block takes "
    "one to 49 mm deep, two elements of 0.5 mm above its base, and less than half as wide as it, "
    "50 mm; give a smaller nodule, or a larger --block\n");
  EXPECT_NE(
    refused("20mm:15mm:5").find("from 15 mm to 55 mm deep and is 40 mm wide"), std::string::npos);
  EXPECT_NE(refused("0.8mm:5mm:5").find("its radius of 0.8 mm is less than two elements of 0.5 mm"),
    std::string::npos);
  EXPECT_NE(refused("5mm:0.6mm:5")
              .find("its highest point, 0.6 mm deep, is less than two elements "
                    "of 0.5 mm below the surface"),
    std::string::npos);
}

TEST(CalibrateCommand, RefusesBadInputInOneLine)
{
  for (const char* bad : { "--tip sphere:60mm", "--threshold 12mm", "--threshold 10mm",
         "--block 100x100mm", "--block 100x100x50", "--material rubber", "--poisson 0.5",
         "--depth 0:90:1mm", "--model cube", "--tip punch:6mm --cap 0mm",
         "--tip truncated-cone:30deg:2mm:8mm --cap 0.01mm", "--sweep /no/such/file.json",
         "--jobs 2", "--sweep extent --jobs 0", "--sweep extent --jobs 99999",
         "--sweep extent --young 5kPa", "--sweep extent --resume", "--sweep stiffness_map",
         "--tables /no/such/folder --tip sphere:3mm", "--stiffness image:kpa.nii",
         "--stiffness 5kPa", "--stiffness formula:z-3", "--stiffness 'formula:sin('",
         "--stiffness formula:9 --model block", "--stiffness formula:9 --nodule 5mm:5mm:3",
         "--stiffness formula:9 --coating 2mm:9kPa:0.4" })
  {
    const Finished finished = calibrate(bad);
    EXPECT_EQ(finished.code, 2) << bad;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

} // namespace
} // namespace palp
