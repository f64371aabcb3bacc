#include "haptics/files/csv_text.h"
#include "tests/support/process.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace palp
{
namespace
{

class MapCommand : public testing::Test
{
protected:
  [[nodiscard]] test::Finished map(const std::string& options) const
  {
    return test::runCommand(PALP_PROGRAM " map " PALP_SHARE "/meshes/block_50.vtp --out " +
      (folder_.path() / "out").string() + " " + options);
  }

  test::TemporaryFolder folder_;
};

// dF/dd of Hertz on the flat faces, by the paper's Eq. (2)
TEST_F(MapCommand, WritesTheStiffnessOfEachPlace)
{
  const test::Finished made =
    map("--depth 2mm --spacing 15mm --around 0,0,0 --radius 20mm --tip sphere:10mm");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("places to 2 mm"), std::string::npos) << made.err;
  const double hertz = 2.0 * 50e3 / (1.0 - 0.33 * 0.33) * std::sqrt(10e-3 * 2e-3) * 1e-3;
  std::ifstream in(folder_.path() / "out/stiffness_map.csv");
  int flat = 0;
  for (std::string line; std::getline(in, line);)
  {
    const std::vector<std::string> cells = csvFields(line);
    if (cells.size() == 11 && cells[0] != "x_mm")
    {
      flat += std::abs(csvNumber(cells[8]).value_or(0.0) - hertz) < 1e-4 * hertz ? 1 : 0;
    }
  }
  EXPECT_GE(flat, 4);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/stiffness_map.vtp"));
  const test::Finished again = map("--depth 2mm");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos) << again.err;
}

// of each by its own tissue: Hertz again, of 20 kPa
TEST_F(MapCommand, OfASceneMapsTheOrganThatIsNamed)
{
  const std::filesystem::path scene = folder_.path() / "two.json";
  std::ofstream(scene)
    << R"({"palp_scene": 1, "plots": ["force-time"], "organs": [)"
    << R"({"name": "block", "bundled": "block_50", "tissue": {"young": "20kPa", "poisson": 0.33}},)"
    << R"({"name": "ball", "bundled": "sphere_30", "frame": {"origin": ["300mm", "0mm", "0mm"]}}]})";
  const auto of = [&](const std::string& options)
  {
    return test::runCommand(PALP_PROGRAM " map " + scene.string() + " --out " +
      (folder_.path() / "out").string() +
      " --depth 2mm --spacing 15mm --around 0,0,0 --radius 20mm " + options);
  };
  for (const auto& [options, why] : { std::pair("", "give one: block, ball"),
         std::pair("--pressed liver", "'liver' is none of the scene: block, ball"),
         std::pair("--pressed block --young 5kPa", "--young: the scene has tool, tissue and law") })
  {
    const test::Finished refused = of(options);
    EXPECT_EQ(refused.code, 2) << options;
    EXPECT_NE(refused.err.find(why), std::string::npos) << options << ": " << refused.err;
  }
  const test::Finished made = of("--pressed block");
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string table = test::readAll(folder_.path() / "out/stiffness_map.csv");
  EXPECT_NE(table.find("# surface: block\n"), std::string::npos);
  const double hertz = 2.0 * 20e3 / (1.0 - 0.33 * 0.33) * std::sqrt(10e-3 * 2e-3) * 1e-3;
  int flat = 0;
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);)
  {
    const std::vector<std::string> cells = csvFields(line);
    const bool isPlace = cells.size() == 11 && cells[0] != "x_mm";
    flat += isPlace && std::abs(csvNumber(cells[8]).value_or(0.0) - hertz) < 1e-4 * hertz ? 1 : 0;
  }
  EXPECT_GE(flat, 4);
}

TEST_F(MapCommand, RefusesInOneSentence)
{
  for (const auto& [options, why] :
    { std::pair("--spacing 0.1mm", "0.5mm to 200mm"), std::pair("--around 0,0,25", "give both"),
      std::pair("--spacing 0.5mm", "20000"), std::pair("--depth 60mm", "nowhere"),
      std::pair("--around 0,0,900 --radius 5mm", "no surface lies in the region") })
  {
    const test::Finished made = map(options);
    EXPECT_EQ(made.code, 2) << options;
    EXPECT_NE(made.err.find(why), std::string::npos) << options << ": " << made.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out"));
  }
}

} // namespace
} // namespace palp
