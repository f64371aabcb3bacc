#include "tests/support/process.h"

#include <algorithm>
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
      << "NDims = 3\nDimSize = 9 9 9\nElementType = MET_UCHAR\nElementDataFile = odd.csv\n";
  }

  void expectRefused(const std::string& arguments)
  {
    const test::Finished run = test::runCommand("cd " + folder_.path().string() +
      " && ulimit -v 4000000 && timeout 20 " PALP_PROGRAM " " + arguments);
    EXPECT_EQ(run.code, 2) << arguments << '\n' << run.err;
    EXPECT_TRUE(run.err.starts_with("palp: ")) << arguments << '\n' << run.err;
    EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << arguments << '\n' << run.err;
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
    expectRefused("calibrate --no-picture --out out --sweep " + name);
  }
  for (const char* file : { "/dev/zero", "odd.json", "folder", "folderodd.json", "absent.json" })
  {
    expectRefused("scene --out out " + std::string(file));
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

} // namespace
} // namespace palp
