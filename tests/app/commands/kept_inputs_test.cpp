#include "tests/support/csv_table.h"
#include "tests/support/process.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <thread>

// --overwrite replaces what an earlier run left, and never what this one reads

namespace palp
{
namespace
{

constexpr const char* kProfile = "radius_mm,height_mm\n0,0\n1,0.1\n2,0.4\n3,0.9\n";
constexpr const char* kCurve = "depth_mm,force_N\n0,0\n1,0.1\n2,0.3\n3,0.6\n4,0.9\n5,1.3\n";
constexpr const char* kRun =
  "run " PALP_SHARE "/meshes/block_50.vtp --at 0,0,0 --depth 1mm --samples-only ";

class KeptInputs : public testing::Test
{
protected:
  KeptInputs()
  {
    std::filesystem::create_directory(out_);
  }

  void write(const std::string& name, const std::string& text) const
  {
    std::ofstream(out_ / name) << text;
  }
  [[nodiscard]] test::Finished palp(const std::string& arguments) const
  {
    return test::runCommand(
      "cd " + folder_.path().string() + " && " PALP_PROGRAM " " + arguments + " --overwrite");
  }

  // whatever else lies there
  void expectKept(const std::string& name, const std::string& arguments) const
  {
    const std::string before = test::readAll(out_ / name);
    const test::Finished run = palp(arguments);
    EXPECT_EQ(run.code, 2) << arguments;
    EXPECT_NE(
      run.err.find(name + ": is read by this run, which would replace it"), std::string::npos)
      << arguments << '\n'
      << run.err;
    EXPECT_EQ(test::sentences(run).size(), 1U) << run.err;
    EXPECT_EQ(test::readAll(out_ / name), before) << arguments;
  }

  test::TemporaryFolder folder_;
  std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(KeptInputs, TheToolOfEachCommand)
{
  for (const auto& [name, command] : { std::pair("presses.csv", std::string(kRun)),
         std::pair("fit.csv", std::string("fit curve.csv --no-picture")),
         std::pair("table.csv", std::string("calibrate --depth 1:2:1mm --no-picture")),
         std::pair("detect.csv",
           std::string("detect --cover 5:6:1mm --depth 1mm --no-picture "
                       "--law corrected --poisson 0.45 --ratio 3")) })
  {
    std::ofstream(folder_.path() / "curve.csv") << kCurve;
    write(name, kProfile);
    expectKept(name, command + " --tip profile:out/" + name + " --out out");
  }
  const std::string goesOn = "calibrate --depth 1:2:1mm --no-picture --tip profile:out/table.csv";
  const test::Finished resumed = test::runCommand(
    "cd " + folder_.path().string() + " && " PALP_PROGRAM " " + goesOn + " --resume --out out");
  EXPECT_EQ(resumed.code, 2) << resumed.err;
  EXPECT_EQ(test::readAll(out_ / "table.csv"), kProfile);
}

TEST_F(KeptInputs, TheTableOfTheDent)
{
  write("samples.csv", test::readAll(PALP_SHARE "/tables/sphere_r10_h50.csv"));
  expectKept("samples.csv", std::string(kRun) + "--table out/samples.csv --out out");
}

TEST_F(KeptInputs, TheVoxelsBehindAHeader)
{
  std::string voxels(27, '\0');
  voxels[13] = 1;
  write("presses.csv", voxels);
  write("image.mhd",
    "ObjectType = Image\nNDims = 3\nDimSize = 3 3 3\nElementSpacing = 5 5 5\n"
    "ElementType = MET_UCHAR\nElementDataFile = presses.csv\n");
  expectKept("presses.csv", "run out/image.mhd --level 0.5 --at 0,0,0 --samples-only --out out");
}

TEST_F(KeptInputs, APlaceList)
{
  write("scene.json",
    "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n"
    "# columns = id,x,y,z\n1,0,0,0\n");
  std::filesystem::create_symlink("out/scene.json", folder_.path() / "points.fcsv");
  const test::Finished run = palp("run " PALP_SHARE "/meshes/block_50.vtp --points points.fcsv "
                                  "--depth 1mm --samples-only --out out");
  EXPECT_EQ(run.code, 2) << run.err;
  EXPECT_NE(run.err.find("points.fcsv: is read by this run"), std::string::npos) << run.err;
}

// its own scene in another layout, and an export that is repeated into its own folder
TEST_F(KeptInputs, TheScene)
{
  write("scene.json",
    R"({"palp_scene": 1, "meshes": [{"bundled": "block_50"}], "device": "path:)" PALP_SHARE
    R"(/paths/block_press.csv", "dent": {"surface": "none"}, "exports": ["samples"]})");
  expectKept("scene.json", "scene out/scene.json --out out");
  ASSERT_EQ(palp(std::string(kRun) + "--out first").code, 0);
  const std::string before = test::readAll(folder_.path() / "first/scene.json");
  const test::Finished again = palp("run first --out first");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("write to another file or folder"), std::string::npos) << again.err;
  EXPECT_EQ(test::readAll(folder_.path() / "first/scene.json"), before);
  EXPECT_NE(palp("run first --out again").err.find("repeated to the byte"), std::string::npos);
}

// what lies in --out under a name that no output has is safe, and may be read
TEST_F(KeptInputs, OtherFilesThereMayBeRead)
{
  write("tool.csv", kProfile);
  for (int i = 0; i < 2; ++i)
  {
    const test::Finished run = palp(std::string(kRun) + "--tip profile:out/tool.csv --out out");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(test::readAll(out_ / "tool.csv"), kProfile);
  }
}

// of two bodies that take turns under one name, the one that was pressed is the one that is named
TEST_F(KeptInputs, TheHashIsOfWhatWasPressed)
{
  const std::string file = (folder_.path() / "body.vtp").string();
  std::map<std::string, double> thickness; // [mm] by hash
  for (const auto& [name, mm] : { std::pair("block_50", 50.0), { "block_30", 30.0 } })
  {
    const std::string body = PALP_SHARE "/meshes/" + std::string(name) + ".vtp";
    const std::string hash = test::runCommand("sha256sum " + body).out.substr(0, 64);
    thickness[hash] = mm;
    std::filesystem::copy_file(body, folder_.path() / (std::string(name) + ".vtp"));
  }
  std::atomic<bool> done = false;
  std::atomic<int> longest = 100; // [ms] of a turn; more where a run takes longer
  std::thread turns(
    [&]
    {
      for (int i = 0; !done; ++i)
      {
        const std::string fresh = file + ".fresh";
        const auto of = folder_.path() / (i % 2 == 0 ? "block_50.vtp" : "block_30.vtp");
        std::filesystem::copy_file(of, fresh);
        std::filesystem::rename(fresh, file);
        std::this_thread::sleep_for(std::chrono::milliseconds(13 + i * 37 % longest));
      }
    });
  int pressed = 0;
  for (int i = 0; i < 24 || pressed == 0; ++i)
  {
    const test::Finished run =
      palp("run body.vtp --at 0,0,0 --depth 1mm --speed 50mm/s --samples-only --out turn");
    if (run.code != 0)
    {
      // the reader may open the file that was named first, not the one that took its name since
      EXPECT_TRUE(run.err.find("was changed while it was read") != std::string::npos ||
        run.err.find("body.vtp: cannot be read") != std::string::npos ||
        run.err.find("body.vtp: cannot be opened") != std::string::npos)
        << run.err;
      longest += 50;
      continue;
    }
    ++pressed;
    const std::string text = test::readAll(folder_.path() / "turn/samples.csv");
    const std::string hash = text.substr(text.find("SHA-256 ") + 8, 64);
    const test::CsvTable samples = test::readCsv(folder_.path() / "turn/samples.csv");
    ASSERT_TRUE(thickness.contains(hash)) << hash;
    EXPECT_NEAR(std::ranges::min(samples["thickness_mm"]), thickness[hash], 1.0);
  }
  done = true;
  turns.join();
}

} // namespace
} // namespace palp
