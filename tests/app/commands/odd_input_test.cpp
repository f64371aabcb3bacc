#include "tests/support/process.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <vector>

// what is no file where one is expected: one sentence at once, whoever asks for it

namespace palp
{
namespace
{

class OddInput : public testing::Test
{
protected:
  OddInput()
  {
    const std::filesystem::path& folder = folder_.path();
    std::filesystem::create_directory(folder / "folder");
    for (const char* ending :
      { ".stl", ".ply", ".vtp", ".mhd", ".nii", ".nii.gz", ".json", ".csv" })
    {
      const std::string name = std::string("odd") + ending;
      std::filesystem::create_symlink("/dev/zero", folder / name);
      std::filesystem::create_directory(folder / ("folder" + name));
      mkfifo((folder / ("pipe" + name)).c_str(), 0600);
    }
    std::ofstream(folder / "beside.mhd")
      << "NDims = 3\nDimSize = 9 9 9\nElementSpacing = 2 2 2\nElementType = MET_UCHAR\n"
         "ElementDataFile = odd.csv\n";
  }

  void expectRefused(const std::string& arguments)
  {
    const test::Finished run = test::runCommand("cd " + folder_.path().string() +
      " && ulimit -v 4000000 && timeout 20 " PALP_PROGRAM " " + arguments);
    EXPECT_EQ(run.code, 2) << arguments << '\n' << run.err;
    EXPECT_TRUE(run.err.starts_with("palp: ")) << arguments << '\n' << run.err;
    EXPECT_EQ(test::sentences(run).size(), 1U) << arguments << '\n' << run.err;
    EXPECT_EQ(run.err.find("memory"), std::string::npos) << arguments << '\n' << run.err;
  }

  test::TemporaryFolder folder_;
};

TEST_F(OddInput, OfSurfacesAndImagesIsRefused)
{
  for (const char* ending : { ".stl", ".ply", ".vtp", ".mhd", ".nii", ".nii.gz" })
  {
    for (const char* kind : { "odd", "folderodd", "pipeodd" })
    {
      expectRefused("run " + std::string(kind) + ending +
        " --no-picture --out out --path " PALP_SOURCE_DIR "/data/paths/block_press.csv");
    }
  }
  expectRefused("run beside.mhd --level 1 --no-picture --out out --path " PALP_SOURCE_DIR
                "/data/paths/block_press.csv");
  expectRefused(
    "run /dev/zero --no-picture --out out --path " PALP_SOURCE_DIR "/data/paths/block_press.csv");
}

TEST_F(OddInput, OfTextsIsRefused)
{
  for (const char* file : { "/dev/zero", "odd.csv", "folder", "folderodd.csv", "absent.csv" })
  {
    const std::string name = file;
    for (const std::string option : { "--path ", "--reference ", "--table ", "--tip profile:" })
    {
      expectRefused("run --no-picture --out out " + option + name);
    }
    expectRefused("force --tip profile:" + name);
    expectRefused("calibrate --out out --sweep " + name);
  }
  for (const char* file : { "/dev/zero", "odd.json", "folder", "folderodd.json", "absent.json" })
  {
    expectRefused("scene --out out " + std::string(file));
  }
}

// a spreadsheet begins a CSV file with a byte order mark, and some write semicolons
TEST_F(OddInput, OfSpreadsheetsIsTakenOrTold)
{
  const auto curve = [&](const char* name, const std::string& text)
  {
    std::ofstream(folder_.path() / name) << text;
    return test::runCommand("cd " + folder_.path().string() +
      " && " PALP_PROGRAM " run " PALP_SHARE "/meshes/block_50.vtp --path " PALP_SOURCE_DIR
      "/data/paths/block_press.csv --plots comparison --plot-files csv --overwrite --out out "
      "--reference " +
      name);
  };
  EXPECT_EQ(curve("marked.csv",
              "\xEF\xBB\xBF"
              "depth_mm,force_N\r\n1,0.2\r\n2,0.6\r\n")
              .code,
    0);
  const test::Finished semicolons = curve("semicolons.csv", "depth_mm;force_N\n1;0.2\n");
  EXPECT_EQ(semicolons.code, 2);
  EXPECT_NE(semicolons.err.find("in 'depth_mm;force_N'"), std::string::npos) << semicolons.err;
  const test::Finished twice = curve("twice.csv", "depth_mm,force_N,force_N\n1,0.2,0.3\n");
  EXPECT_NE(twice.err.find("two columns force_N"), std::string::npos) << twice.err;
}

// two blocks that overlap, as segmentations leave folds
TEST_F(OddInput, OfASurfaceThatCrossesItselfIsTakenAndTold)
{
  std::ofstream mesh(folder_.path() / "two.obj");
  for (const double shift : { 0.0, 33.0 })
  {
    for (int i = 0; i < 8; ++i)
    {
      mesh << "v " << 40 * (i & 1) - 20 + shift << ' ' << 20 * (i & 2) - 20 + 0.1 * shift << ' '
           << 10 * (i & 4) - 40 + 0.05 * shift << '\n';
    }
  }
  for (const int first : { 1, 9 })
  {
    for (const auto& [a, b, c, d] :
      { std::array{ 0, 2, 3, 1 }, std::array{ 4, 5, 7, 6 }, std::array{ 0, 1, 5, 4 },
        std::array{ 2, 6, 7, 3 }, std::array{ 0, 4, 6, 2 }, std::array{ 1, 3, 7, 5 } })
    {
      mesh << "f " << first + a << ' ' << first + b << ' ' << first + c << '\n'
           << "f " << first + a << ' ' << first + c << ' ' << first + d << '\n';
    }
  }
  mesh.close();
  const test::Finished run = test::runCommand("cd " + folder_.path().string() +
    " && " PALP_PROGRAM " run two.obj --unit mm --no-picture --out out --path " PALP_SOURCE_DIR
    "/data/paths/block_press.csv");
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("the surface crosses, overlaps or touches itself, at "), std::string::npos)
    << run.err;
}

TEST_F(OddInput, OfSilentPipesIsRefused)
{
  expectRefused("scene --out out pipeodd.json");
  const test::Finished piped = test::runCommand("cd " + folder_.path().string() +
    " && (sleep 1; cat " PALP_SOURCE_DIR "/data/scenes/block_force.json) | " PALP_PROGRAM
    " scene /dev/stdin --out out");
  EXPECT_EQ(piped.err.find("palp: /dev/stdin"), std::string::npos) << piped.err;
}

TEST_F(OddInput, IsReadOnceWhereItIsAPipe)
{
  const test::Finished run = test::runCommand("cd " + folder_.path().string() +
    " && (cat " PALP_SOURCE_DIR
    "/data/paths/block_press.csv > pipeodd.csv &) && timeout 20 " PALP_PROGRAM " run " PALP_SHARE
    "/meshes/block_50.vtp --no-picture --out out --path pipeodd.csv");
  EXPECT_EQ(run.code, 0) << run.err;
}

TEST_F(OddInput, OfRadiiThatAreNoneIsRefused)
{
  for (const char* radius : { "-5", "1e6" })
  {
    std::ofstream(folder_.path() / "radii.csv")
      << "depth_mm,extent_radius_mm,force_N,contact_radius_mm\n1," << radius << ",1,1\n2,6,2,2\n";
    expectRefused("run --no-picture --out out --table radii.csv");
  }
}

TEST_F(OddInput, OfFoldersToWriteIsRefused)
{
  for (const char* out : { "/dev/zero", "odd.csv", "pipeodd.csv", "beside.mhd", "/proc/here" })
  {
    expectRefused("run --no-picture --out " + std::string(out));
    expectRefused("stability --quick --out " + std::string(out));
    expectRefused("calibrate --no-picture --out " + std::string(out));
  }
}

// a reader that takes its time, in a copy of the program: what is read is told, and can be stopped
TEST(SlowInput, IsToldAfterTwoSecondsAndEndsWithTheInterrupt)
{
  const test::TemporaryFolder folder;
  const std::filesystem::path bin = folder.path() / "bin";
  std::filesystem::create_directory(bin);
  std::filesystem::copy_file(PALP_PROGRAM, bin / "palp");
  std::ofstream(bin / "palp-read") << "#!/bin/sh\nexec sleep 60\n";
  std::filesystem::permissions(bin / "palp-read", std::filesystem::perms::owner_all);
  std::ofstream(folder.path() / "liver.stl") << "solid";
  const std::string here = folder.path().string();
  const test::Finished stopped =
    test::runCommand("cd " + here + "; PALP_DATA=" PALP_SHARE " " + bin.string() +
      "/palp run liver.stl --no-picture --out out --path " PALP_SHARE
      "/paths/liver_press.csv 2> told & running=$!; "
      "until [ -s told ]; do sleep 0.05; done; kill -INT $running; wait $running; "
      "code=$?; cat told >&2; exit $code");
  EXPECT_EQ(stopped.code, 130) << stopped.err; // of SIGINT
  EXPECT_NE(stopped.err.find("palp: reading liver.stl, 2 s"), std::string::npos) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "samples.csv"));
}

} // namespace
} // namespace palp
