#include "tests/app/commands/run_rig.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <map>

namespace palp
{
namespace
{

using namespace test;

class ExportFolders : public RunCommand
{
protected:
  [[nodiscard]] std::string folder(const std::string& name) const
  {
    return (folder_.path() / name).string();
  }

  // all files of a folder, as they are
  [[nodiscard]] std::map<std::string, std::string> contents(const std::string& name) const
  {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder(name)))
    {
      files[entry.path().filename().string()] = test::readAll(entry.path());
    }
    return files;
  }

  void expectRepeated(const std::string& options, std::size_t count)
  {
    const Finished first = palp("run " + options + " --overwrite --out " + folder("first"));
    ASSERT_EQ(first.code, 0) << first.err;
    const Finished again = palp("run " + folder("first") + " --overwrite --out " + folder("again"));
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_NE(again.err.find("repeated to the byte"), std::string::npos) << again.err;
    const auto before = contents("first");
    const auto after = contents("again");
    EXPECT_EQ(before.size(), count) << options;
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [name, bytes] : before)
    {
      EXPECT_TRUE(after.at(name) == bytes) << name;
    }
  }

  [[nodiscard]] std::string onTop() const
  {
    return " --at 3,-2," + std::to_string(topMm()) + " --speed 50mm/s";
  }
};

// with pictures, options of every kind, and a path of the user's
TEST_F(ExportFolders, AreRepeatedToTheByte)
{
  const auto reference = folder_.path() / "mine.csv";
  std::ofstream(reference) << "depth_mm,force_N\n1,0.25\n4,2.0\n";
  expectRepeated(block() + onTop() + " --size 320x240 --plots force-depth,comparison --reference " +
      reference.string() + " --plot-files csv --refined --young 12.345kPa --tip cone:44.7deg:9.1mm",
    8); // scene, provenance, samples, presses, mesh, picture, curve, comparison
  const auto path = writePath(folder_.path(),
    ("0,0,0," + std::to_string(topMm() + 3) + "\n0.31,0.1,0," + std::to_string(topMm() - 3.3) +
      "\n")
      .c_str());
  expectRepeated(
    block() + " --no-picture --all-samples --chain --damping 3N*s/m --path " + path.string(), 6);
}

// as a user names them who stands beside them
TEST_F(ExportFolders, OfFilesByRelativePathsAreRepeatedToTheByte)
{
  std::filesystem::copy_file(block(), folder("block.vtp"));
  std::ofstream(folder("tip.csv")) << "radius_mm,height_mm\n0,0\n2,0.3\n4,1.2\n8,4.8\n";
  const auto relative = [&](const std::string& name)
  { return std::filesystem::relative(folder(name)).string(); };
  expectRepeated(relative("block.vtp") + onTop() +
      " --no-picture --samples-only --tip profile:" + relative("tip.csv"),
    4);
}

// a hand's motion, told by a file of rows: what the device got stays, what follows from it is anew
TEST_F(ExportFolders, OfARecordingAreRepeatedRowByRow)
{
  expectRepeated(block() + onTop() + " --no-picture --damping 5N*s/m", 5);
  const std::filesystem::path hand = folder_.path() / "hand";
  std::filesystem::create_directory(hand);
  std::string samples = test::readAll(folder("first") + "/samples.csv");
  samples.replace(samples.find("# device: given places"), 22, "# device: hand");
  std::ofstream(hand / "samples.csv") << samples;
  std::ofstream(hand / "scene.json")
    << R"({"palp_scene": 1, "meshes": [{"file": ")" << block()
    << R"("}], "tissue": {"damping": "5N*s/m"}, "law": {"validity": true},
    "recording": {"device": "hand", "names": ["first"]}, "exports": ["samples"]})";
  std::ofstream(hand / "provenance.json")
    << R"({"palp": "0", "command": "palp run )" << block() << onTop()
    << R"( --no-picture --damping '5N*s/m'", "device": "hand"})";
  const Finished finished = palp("run " + hand.string() + " --out " + folder("out"));
  ASSERT_EQ(finished.code, 0) << finished.err;
  EXPECT_EQ(test::readAll(folder("out") + "/samples.csv"), samples);
  const std::string presses = test::readAll(folder("out") + "/presses.csv");
  const std::string before = test::readAll(folder("first") + "/presses.csv");
  EXPECT_NE(presses.find("\"first\","), std::string::npos);
  EXPECT_EQ(
    presses.substr(presses.find("\"first\"") + 7), before.substr(before.find("\"press 1\"") + 9));
}

TEST_F(ExportFolders, TellWhatWasChangedInThem)
{
  ASSERT_EQ(palp("run " + block() + onTop() + " --no-picture --out " + folder("first")).code, 0);
  std::ofstream(folder("first") + "/samples.csv", std::ios::app) << "1,2,3\n";
  std::filesystem::remove(folder("first") + "/deformed.vtp");
  const Finished again = palp("run " + folder("first") + " --out " + folder("again"));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_NE(
    again.err.find("changed or removed since: deformed.vtp, samples.csv"), std::string::npos)
    << again.err;
}

TEST_F(ExportFolders, RefuseWhatContradictsThem)
{
  ASSERT_EQ(palp("run " + block() + onTop() + " --no-picture --out " + folder("first")).code, 0);
  for (const std::string options : { "--depth 3mm", "--young 1kPa", "--chain", "--unit mm" })
  {
    const Finished run = palp("run " + folder("first") + " " + options + " --out " + folder("b"));
    EXPECT_EQ(run.code, 2) << options;
    EXPECT_NE(run.err.find("is an export, whose scene.json says that"), std::string::npos)
      << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  const Finished view = palp("view " + folder("first") + " --tip sphere:2mm");
  EXPECT_EQ(view.code, 2) << view.err;
  EXPECT_NE(view.err.find("--tip: "), std::string::npos) << view.err;
  const Finished window = palp("view " + folder("first"));
  EXPECT_EQ(window.code, 4) << window.err; // no display here
}

TEST_F(ExportFolders, RefuseASurfaceThatHasChanged)
{
  const auto mesh = folder_.path() / "mine.vtp";
  std::filesystem::copy_file(block(), mesh);
  ASSERT_EQ(
    palp("run " + mesh.string() + onTop() + " --no-picture --out " + folder("first")).code, 0);
  std::filesystem::copy_file(
    PALP_SHARE "/meshes/block_30.vtp", mesh, std::filesystem::copy_options::overwrite_existing);
  const Finished changed = palp("run " + folder("first") + " --out " + folder("again"));
  EXPECT_EQ(changed.code, 2) << changed.err;
  EXPECT_NE(
    changed.err.find("mine.vtp is another file than the one it was made from"), std::string::npos)
    << changed.err;
  std::filesystem::remove(mesh);
  const Finished gone = palp("run " + folder("first") + " --out " + folder("again"));
  EXPECT_EQ(gone.code, 2) << gone.err;
  EXPECT_EQ(std::count(gone.err.begin(), gone.err.end(), '\n'), 1) << gone.err;
  EXPECT_FALSE(std::filesystem::exists(folder("again")));
}

} // namespace
} // namespace palp
