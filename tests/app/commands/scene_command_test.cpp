#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace palp
{
namespace
{

using test::Finished;

// what --explain prints
struct Explained
{
  std::set<std::string> built;
  std::set<std::string> leftOut;
  std::string total;

  // the number after a word of the last line
  [[nodiscard]] double after(const std::string& word) const
  {
    const std::size_t at = total.find(word);
    EXPECT_NE(at, std::string::npos) << word << " in " << total;
    return std::strtod(total.c_str() + at + word.size(), nullptr);
  }
};

Explained explained(const std::string& text)
{
  Explained result;
  std::set<std::string>* list = nullptr;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::string name = line.substr(0, line.find("  "));
    if (name == "built" || name == "left out")
    {
      list = name == "built" ? &result.built : &result.leftOut;
    }
    else if (line.starts_with("total:"))
    {
      result.total = line;
    }
    else if (list && !line.empty())
    {
      list->insert(name);
    }
  }
  return result;
}

class SceneCommand : public ::testing::Test
{
protected:
  [[nodiscard]] Finished scene(const std::string& arguments) const
  {
    return test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " scene " +
      arguments + " --overwrite --out " + (folder_.path() / "out").string());
  }
  [[nodiscard]] test::CsvTable samples() const
  {
    return test::readCsv(folder_.path() / "out/samples.csv");
  }

  // the least scene with some keys changed
  [[nodiscard]] std::string written(const std::string& exports, const std::string& dent) const
  {
    const std::filesystem::path file = folder_.path() / "scene.json";
    std::ofstream(file) << R"({"palp_scene": 1, "meshes": [{"bundled": "block_50"}],
      "device": "path:)" PALP_SHARE R"(/paths/block_press.csv", "dent": {"surface": ")"
                        << dent << R"("}, "exports": )" << exports << "}";
    return file.string();
  }

  test::TemporaryFolder folder_;
};

TEST_F(SceneCommand, TheLeastSceneIsSmallAndCorrect)
{
  const Finished finished = scene("block_force --explain");
  ASSERT_EQ(finished.code, 0) << finished.err;
  const Explained last = explained(finished.out);
  std::printf("%.0f ms\n", last.after("total: ")); // no gate
  EXPECT_LE(last.after("peak memory "), 100.0) << last.total;
  EXPECT_LE(last.after("threads "), 2.0) << last.total;
  for (const char* family : { "(Qt ", "X11/GL ", "USB " })
  {
    EXPECT_EQ(last.after(family), 0.0) << last.total;
  }

  const test::CsvTable table = samples();
  const double deepest = *std::max_element(table["force_N"].begin(), table["force_N"].end());
  EXPECT_NEAR(deepest, 4.0 / 3.0 * 50e3 / (1 - 0.33 * 0.33) * 0.01 * 0.01, 1e-4 * deepest);
}

TEST_F(SceneCommand, AnAddedPartAddsOnlyItself)
{
  const Finished few = scene(written(R"(["samples"])", "none") + " --explain");
  const Finished more = scene(written(R"(["samples", "deformed"])", "paper") + " --explain");
  ASSERT_EQ(few.code, 0) << few.err;
  ASSERT_EQ(more.code, 0) << more.err;
  const Explained before = explained(few.out);
  const Explained after = explained(more.out);
  std::set<std::string> added;
  std::set_difference(after.built.begin(), after.built.end(), before.built.begin(),
    before.built.end(), std::inserter(added, added.end()));
  EXPECT_EQ(added, (std::set<std::string>{ "calibration", "deformed.vtp" }));
  EXPECT_TRUE(before.leftOut.contains("calibration, dent"));
  EXPECT_FALSE(after.leftOut.contains("calibration, dent"));
  EXPECT_TRUE(after.leftOut.contains("OpenGL"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/deformed.vtp"));
}

// no library talks in between, in colors of a terminal
// as palp force answers for the same nodule, which is compared with finite elements
TEST_F(SceneCommand, FeelsANoduleInTheBody)
{
  const std::filesystem::path file = folder_.path() / "nodule.json";
  const auto press = [&](const std::string& nodules)
  {
    std::ofstream(file) << R"({"palp_scene": 1, "meshes": [{"bundled": "block_50", "nodules": [)"
                        << nodules << R"(]}], "law": {"mode": "corrected", "material": "linear"},
      "device": "path:)" PALP_SHARE R"(/paths/block_press.csv", "dent": {"surface": "none"},
      "plots": [], "exports": ["samples"]})";
    return scene(file.string());
  };
  const auto deepest = [](const test::CsvTable& table)
  { return *std::max_element(table["force_N"].begin(), table["force_N"].end()); };
  ASSERT_EQ(press("").code, 0);
  const test::CsvTable plain = samples();
  EXPECT_EQ(plain.columns.count("factor_nodules"), 0U);
  ASSERT_EQ(press(R"({"center": ["0mm", "0mm", "-10mm"], "radius": "5mm", "ratio": 5})").code, 0);
  const test::CsvTable felt = samples();
  std::istringstream answer(test::runCommand(PALP_PROGRAM
    " force --tip sphere:10mm --young 50kPa --poisson 0.33 --law corrected --material linear "
    "--thickness 50mm --nodule 5mm:5mm:5 --depth 10:10:1mm")
                              .out);
  const double expected = test::parseCsv(answer)["force_N"][0];
  EXPECT_NEAR(deepest(felt), expected, 1e-3 * expected);
  EXPECT_GT(deepest(felt), 1.03 * deepest(plain));
  EXPECT_NEAR(felt["factor_nodules"].front(), 1.0, 1e-12);

  // the most of the force's factor is that of the deepest moment, which presses.csv tells
  const std::string presses = test::readAll(folder_.path() / "out/presses.csv");
  EXPECT_NE(presses.find(",law,nodule_1_percent\n"), std::string::npos) << presses;
  const double told = std::stod(presses.substr(presses.rfind(',') + 1));
  const auto& forces = felt["force_N"];
  const auto at = std::ranges::max_element(forces) - forces.begin();
  EXPECT_NEAR(told, 100.0 * (felt["factor_nodules"][static_cast<std::size_t>(at)] - 1.0), 1e-3);

  const Finished outside =
    press(R"({"center": ["0mm", "0mm", "10mm"], "radius": "5mm", "ratio": 5})");
  EXPECT_EQ(outside.code, 2);
  EXPECT_NE(outside.err.find("block_50.vtp: nodules/0"), std::string::npos) << outside.err;
}

TEST_F(SceneCommand, SpeaksInItsOwnWordsAlone)
{
  const Finished finished = scene("paper_block");
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "out/force_depth.png"));
  std::istringstream lines(finished.err);
  for (std::string line; std::getline(lines, line);)
  {
    EXPECT_TRUE(line.starts_with("palp: ")) << line;
  }
}

TEST_F(SceneCommand, WithoutACalibrationNoColumnPretendsToOne)
{
  ASSERT_EQ(scene(written(R"(["samples"])", "none")).code, 0);
  const std::string text = test::readAll(folder_.path() / "out/samples.csv");
  EXPECT_EQ(text.find("extent_radius_mm"), std::string::npos);
  EXPECT_EQ(text.find("broken_rules"), std::string::npos);
  EXPECT_NE(text.find("force_N"), std::string::npos);
}

// each stands where its frame puts it, and to 9 mm a hand cannot tell them apart: Fig. 3, 7 %
TEST_F(SceneCommand, PressesThreeSpheresWhereTheyStand)
{
  const std::string text = test::readAll(PALP_SHARE "/scenes/paper_spheres.json");
  const std::string plain = folder_.path() / "spheres.json";
  std::string changed = text; // the same without pictures
  const auto replace = [&](const std::string& from, const std::string& to)
  { changed.replace(changed.find(from), from.size(), to); };
  replace(R"(["force-depth", "force-time"])", "[]");
  replace(R"(["samples", "picture"])", R"(["samples"])");
  replace("../paths/", PALP_SHARE "/paths/");
  std::ofstream(plain) << changed;
  const Finished finished = scene(plain);
  ASSERT_EQ(finished.code, 0) << finished.err;

  const test::CsvTable table = samples();
  double peak[3] = { 0.0, 0.0, 0.0 }; // of the spheres of 30, 50, 100 mm
  for (std::size_t i = 0; i < table["time_s"].size(); ++i)
  {
    const double x = table["tool_x_mm"][i];
    const double force = table["force_N"][i];
    double& highest = peak[x > 100.0 ? 0 : x < -100.0 ? 1 : 2];
    highest = std::max(highest, force);
    if (table["tool_z_mm"][i] > 0.5)
    {
      EXPECT_EQ(force, 0.0) << "above the tops, at x = " << x;
    }
  }
  EXPECT_GT(peak[0], 3.0);
  const auto [least, most] = std::minmax_element(std::begin(peak), std::end(peak));
  EXPECT_LT(*most, 1.07 * *least);
}

TEST_F(SceneCommand, SaysSoWhereThereIsNoDisplayOrNoScene)
{
  const Finished window = scene("liver_mouse");
  EXPECT_EQ(window.code, 4) << window.err;
  const Finished missing = scene("nowhere");
  EXPECT_EQ(missing.code, 2);
  EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
}

} // namespace
} // namespace palp
