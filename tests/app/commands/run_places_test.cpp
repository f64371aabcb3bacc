#include "tests/app/commands/run_rig.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace test;

class RunPlaces : public RunCommand
{
protected:
  [[nodiscard]] Finished at(const std::string& options, const std::string& out)
  {
    return palp(
      "run " + block() + " --no-picture --out " + (folder_.path() / out).string() + " " + options);
  }

  [[nodiscard]] std::string point(double x, double y, double z) const
  {
    std::ostringstream text;
    text << x << ',' << y << ',' << z;
    return text.str();
  }

  // the rows of presses.csv by their first cells
  [[nodiscard]] std::vector<std::string> presses(const std::string& out) const
  {
    std::ifstream in(folder_.path() / out / "presses.csv");
    std::vector<std::string> rows;
    for (std::string line; std::getline(in, line);)
    {
      if (line.starts_with('"'))
      {
        rows.push_back(line);
      }
    }
    return rows;
  }
};

constexpr double kHertz = 4.0 / 3.0 * 50e3 / (1 - 0.33 * 0.33) * 0.1 * 3.5355339059327376e-4;

TEST_F(RunPlaces, PressesOneExactlySaidPlace)
{
  const Finished finished = at("--at " + point(-12.5, 7.25, topMm() + 1.0) + " --depth 5mm", "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const test::CsvTable samples = test::readCsv(folder_.path() / "out/samples.csv");
  const auto& force = samples["force_N"];
  const auto deepest = std::max_element(force.begin(), force.end()) - force.begin();
  const auto k = static_cast<std::size_t>(deepest);
  EXPECT_NEAR(samples["depth_mm"][k], 5.0, 1e-9);
  EXPECT_NEAR(force[k], kHertz, 1e-4 * kHertz);
  EXPECT_NEAR(samples["tool_x_mm"][k], -12.5, 1e-9);
  EXPECT_NEAR(samples["tool_y_mm"][k], 7.25, 1e-9);
  // of contact alone, but for its neighbors
  EXPECT_EQ(std::ranges::count(samples["depth_mm"], 0.0), 2);
  EXPECT_EQ(samples["depth_mm"].front(), 0.0);
  EXPECT_EQ(samples["depth_mm"].back(), 0.0);
  const auto rows = presses("out");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_TRUE(rows[0].starts_with("\"press 1\",")) << rows[0];
}

TEST_F(RunPlaces, TakesSeveralAndTheListsOfSlicer)
{
  const auto list = folder_.path() / "F.fcsv";
  std::ofstream(list)
    << "# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n"
       "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
    << "1,20,-10," << topMm() << ",0,0,0,1,1,1,0,lobe,,\n";
  const std::string options = "--at " + point(0, 0, topMm()) + " --at " + point(10, 0, topMm()) +
    " --points " + list.string() + " --speed 50mm/s";
  const Finished finished = at(options, "out");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const auto rows = presses("out");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_TRUE(rows[2].starts_with("\"lobe\",")) << rows[2];
  // RAS turned round: the list says x = 20, y = -10
  const test::CsvTable samples = test::readCsv(folder_.path() / "out/samples.csv");
  EXPECT_NEAR(samples["tool_x_mm"].back(), -20.0, 1e-6);
  EXPECT_NEAR(samples["tool_y_mm"].back(), 10.0, 1e-6);
}

// the deepest press is within the limits, the other one at an edge
TEST_F(RunPlaces, CountsThePressesOutsideTheLimits)
{
  const std::string places = "--depth 1mm --speed 50mm/s --at " + point(0, 0, topMm());
  EXPECT_EQ(at(places, "one").err.find("presses the law"), std::string::npos);
  const Finished both = at(places + " --at " + point(49, 0, topMm()), "both");
  EXPECT_NE(both.err.find("in 1 of 2 presses (press 2) the law is outside its limits; presses.csv"),
    std::string::npos)
    << both.err;
  const Finished deep =
    at("--depth 12mm --speed 50mm/s --at " + point(0, 0, topMm()) + " --at " + point(5, 0, topMm()),
      "deep");
  EXPECT_NE(deep.err.find("warning: in press "), std::string::npos) << deep.err;
}

TEST_F(RunPlaces, RefusesInOneSentence)
{
  const std::string good = "--at " + point(0, 0, topMm());
  for (const auto& [options, word] :
    std::vector<std::pair<std::string, std::string>>{
      { "--at " + point(0, 0, topMm() + 30), "30 mm off the surface" }, { "--at 1,2", "no place" },
      { "--at 1,2,x", "is not a number" }, { good + " --depth 5", "has no unit" },
      { good + " --depth 60mm", "more than half of the" },
      { good + " --speed 5mm", "has the unit" }, { good + " --path x.csv", "excludes" },
      { "--depth 5mm", "--at and --points" }, { "--points none.fcsv", "none.fcsv" } })
  {
    const Finished finished = at(options, "none");
    EXPECT_EQ(finished.code, 2) << options;
    EXPECT_NE(finished.err.find(word), std::string::npos) << options << '\n' << finished.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "none")) << options;
  }
}

} // namespace
} // namespace palp
