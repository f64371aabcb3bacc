#include "data/shapes.h"
#include "tests/support/csv_table.h"
#include "tests/support/obj_file.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace palp
{
namespace
{

using test::Finished;

Finished palp(const std::string& arguments)
{
  return test::runCommand("env -u DISPLAY -u WAYLAND_DISPLAY " PALP_PROGRAM " " + arguments);
}

/// A player who scans the top of a block of 200 x 200 x 50 mm line by line, 4 mm deep.
class TrainCommand : public ::testing::Test
{
protected:
  TrainCommand()
  {
    const Mesh mesh = makeBox({ 200.0, 200.0, 50.0 }, 5.0); // in mm, as the file
    test::writeObj(folder() / "block.obj", mesh.points, mesh.triangles, Eigen::Vector3d::Ones());
    std::ofstream path(folder() / "scan.csv");
    path << "time_s,x_mm,y_mm,z_mm\n0,-75,-75,5\n";
    double time = 0.1;
    double x = -75.0;
    for (int y = -75; y <= 75; y += 5)
    {
      path << time << ',' << x << ',' << y << ",-4\n";
      x = -x;
      time += 0.4;
      path << time << ',' << x << ',' << y << ",-4\n";
      time += 0.03;
    }
    path << time << ',' << x << ",75,5\n";
  }

  [[nodiscard]] std::filesystem::path folder() const
  {
    return folder_.path();
  }

  [[nodiscard]] std::string file(const char* name) const
  {
    return (folder() / name).string();
  }

  void mark(const std::vector<double>& times)
  {
    std::ofstream marks(folder() / "marks.csv");
    marks << "time_s\n";
    for (const double time : times)
    {
      marks << time << '\n';
    }
  }

  Finished train(const std::string& extra)
  {
    return palp("train " + file("block.obj") + " --unit mm --side 0,0,1 --path " +
      file("scan.csv") + " --marks " + file("marks.csv") + ' ' + extra);
  }

  [[nodiscard]] nlohmann::json score(const char* out) const
  {
    return nlohmann::json::parse(test::readAll(folder() / out / "score.json"));
  }

  // where the force stands out of what is usual, the strongest first, none within 25 mm of another
  [[nodiscard]] std::vector<double> strongest(const char* out) const
  {
    const test::CsvTable felt = test::readCsv(folder() / out / "samples.csv");
    const std::vector<double>& forces = felt["force_N"];
    std::vector<double> sorted = forces;
    std::ranges::nth_element(sorted, sorted.begin() + static_cast<long>(sorted.size() / 2));
    const double usual = sorted[sorted.size() / 2];
    std::vector<std::size_t> order(forces.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::sort(order, std::greater{}, [&](std::size_t i) { return forces[i]; });
    std::vector<double> marks;
    std::vector<std::size_t> marked;
    for (const std::size_t i : order)
    {
      const auto isNear = [&](std::size_t k)
      {
        return std::hypot(felt["tool_x_mm"][i] - felt["tool_x_mm"][k],
                 felt["tool_y_mm"][i] - felt["tool_y_mm"][k]) < 25.0;
      };
      if (forces[i] > 1.2 * usual && std::ranges::none_of(marked, isNear))
      {
        marked.push_back(i);
        marks.push_back(felt["time_s"][i]);
      }
    }
    return marks;
  }

  test::TemporaryFolder folder_;
};

// who knows nothing but times, places and forces
TEST_F(TrainCommand, AScanThatMarksTheStiffestPlacesFindsTheEasyNodules)
{
  for (const std::string seed : { "1", "2" })
  {
    mark({});
    const Finished blind = train("--seed " + seed + " --out " + file("blind") + " --overwrite");
    ASSERT_EQ(blind.code, 0) << blind.err;
    EXPECT_EQ(score("blind")["measures"]["hits"], 0);
    mark(strongest("blind"));
    const Finished finished = train("--seed " + seed + " --out " + file("graded") + " --overwrite");
    ASSERT_EQ(finished.code, 0) << finished.err;
    const nlohmann::json measures = score("graded")["measures"];
    EXPECT_EQ(measures["hits"], 3);
    EXPECT_EQ(measures["false_marks"], 0);
    EXPECT_LT(measures["distance_error_mm"], 5.0);
    EXPECT_LT(measures["hits_by_chance"], 0.5);
    EXPECT_EQ(score("graded")["passed"], true);
    // the scanned square, a contact radius of 6 mm wider, of the top
    EXPECT_NEAR(measures["coverage_percent"], 100.0 * 162.0 * 162.0 / (200.0 * 200.0), 3.0);
  }
}

TEST_F(TrainCommand, IsRepeatedToTheByte)
{
  mark({ 1.25, 3.5 });
  ASSERT_EQ(train("--difficulty hard --seed 5 --out " + file("graded")).code, 0);
  for (const std::string command : { "train ", "run " })
  {
    const Finished again = palp(command + file("graded") + " --overwrite --out " + file("again"));
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
    for (const char* name : { "score.json", "score.csv", "score.html", "samples.csv" })
    {
      EXPECT_EQ(
        test::readAll(folder() / "graded" / name), test::readAll(folder() / "again" / name));
      EXPECT_FALSE(test::readAll(folder() / "again" / name).empty());
    }
  }
}

// also where the folder's own record of its files was changed to match
TEST_F(TrainCommand, SaysThatChangedFiguresDoNotFollowFromTheRecording)
{
  mark({ 1.25, 3.5 });
  ASSERT_EQ(train("--seed 5 --out " + file("graded")).code, 0);
  const auto shaOf = [&]
  {
    const std::string sums = test::runCommand("sha256sum " + file("graded/score.json")).out;
    return sums.substr(0, sums.find(' '));
  };
  const std::string before = shaOf();
  std::string text = test::readAll(folder() / "graded/score.json");
  text.insert(text.find("\"hits\": ") + 8, "1"); // ten more
  std::ofstream(folder() / "graded/score.json") << text;
  const std::string says = "the figures of its score.json do not follow from the recording";
  for (const bool isRecordChanged : { false, true })
  {
    if (isRecordChanged)
    {
      std::string record = test::readAll(folder() / "graded/provenance.json");
      record.replace(record.find(before), before.size(), shaOf());
      std::ofstream(folder() / "graded/provenance.json") << record;
    }
    const Finished again = palp("train " + file("graded") + " --overwrite --out " + file("again"));
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find(says), std::string::npos) << again.err;
    for (const char* other : { "repeated to the byte", "comes out another", "changed or removed" })
    {
      EXPECT_EQ(again.err.find(other), std::string::npos) << again.err;
    }
  }
}

TEST_F(TrainCommand, NamesTheSceneThatAFolderLacks)
{
  mark({ 1.25 });
  ASSERT_EQ(train("--seed 5 --out " + file("graded")).code, 0);
  std::filesystem::remove(folder() / "graded/scene.json");
  std::filesystem::create_directory(folder() / "empty");
  for (const std::string command : { "train ", "run --out again ", "view " })
  {
    for (const char* name : { "graded", "empty" })
    {
      const Finished refused = palp(command + file(name));
      EXPECT_EQ(refused.code, 2) << refused.err;
      EXPECT_NE(refused.err.find(file(name) + ": has no scene.json"), std::string::npos)
        << command << refused.err;
    }
  }
}

TEST_F(TrainCommand, RefusesWhatCannotBeGradedInOneSentence)
{
  mark({ 1.0 });
  const auto expectRefusal = [](const Finished& finished, const char* what)
  {
    EXPECT_EQ(finished.code, 2) << finished.err;
    EXPECT_NE(finished.err.find(what), std::string::npos) << finished.err;
    EXPECT_EQ(test::sentences(finished).size(), 1U) << finished.err;
  };
  const std::string out = "--out " + file("graded");
  expectRefusal(train("--difficulty brutal " + out), "expected one of easy, medium, hard, expert");
  expectRefusal(train("--seed 1.5 " + out), "--seed");
  expectRefusal(train("--nodules 13 " + out), "--nodules");
  expectRefusal(train("--side 0,0,0 " + out), "--side");
  expectRefusal(train(""), "give all three");
  expectRefusal(palp("train --marks " + file("marks.csv")), "give all three");
  for (const double outside : { -1.0, 1e4 })
  {
    mark({ outside });
    expectRefusal(train(out), "a mark is not within the path, from 0 to ");
  }
  EXPECT_FALSE(std::filesystem::exists(folder() / "graded"));
}

TEST_F(TrainCommand, RefusesAMarkBeforeTheFirstTouchAndABodyWithoutRoom)
{
  mark({ 0.01 });
  const Finished early = train("--out " + file("graded"));
  EXPECT_EQ(early.code, 2);
  EXPECT_NE(early.err.find("before the first touch"), std::string::npos) << early.err;
  mark({ 1.0 });
  const Finished full =
    palp("train " PALP_SHARE "/meshes/block_50.vtp --side 0,0,1 --nodules 12 --path " +
      file("scan.csv") + " --marks " + file("marks.csv") + " --out " + file("graded"));
  EXPECT_EQ(full.code, 2);
  EXPECT_NE(full.err.find("find room"), std::string::npos) << full.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "graded"));
}

// each by its key, before a window is asked for
TEST_F(TrainCommand, RefusesAScenesTrainingThatCouldNotBeGraded)
{
  const auto refusal =
    [this](const std::string& law, const std::string& training, const std::string& more)
  {
    std::ofstream(folder() / "scene.json")
      << R"({"palp_scene": 1, "meshes": [{"bundled": "liver"}], "law": {"mode": ")" << law
      << R"("}, "training": )" << training << more << "}";
    return palp("scene " + file("scene.json")).err;
  };
  const std::string plots = R"(, "plots": ["force-time"])";
  EXPECT_NE(
    refusal("corrected", R"({"level": "easy"})", plots).find("no display"), std::string::npos);
  EXPECT_NE(refusal("paper", "{}", plots).find("/training: takes the law"), std::string::npos);
  EXPECT_NE(
    refusal("corrected", R"({"seed": -1})", plots).find("/training/seed"), std::string::npos);
  EXPECT_NE(refusal("corrected", "{}", "").find("give plots"), std::string::npos);
  EXPECT_NE(
    refusal("corrected", R"({"marks": ["1s"]})", plots).find("a window makes"), std::string::npos);
  EXPECT_NE(refusal("corrected", "{}", R"(, "device": "path:scan.csv", "exports": ["samples"])")
              .find("has no marks"),
    std::string::npos);
}

} // namespace
} // namespace palp
