#include "data/shapes.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

class CheckCommand : public testing::Test
{
protected:
  // a ball of 30 mm without a few of its triangles
  std::filesystem::path holedBall()
  {
    Mesh ball = makeSphere(0.03, 3);
    ball.triangles.erase(ball.triangles.begin() + 10);
    ball.triangles.erase(ball.triangles.begin() + 500);
    const std::filesystem::path file = folder_.path() / "holed.stl";
    writeSurface(file, *makePolyData(ball.points, ball.triangles));
    return file;
  }

  test::Finished check(const std::string& arguments)
  {
    return test::runCommand(PALP_PROGRAM " check " + arguments);
  }

  test::TemporaryFolder folder_;
};

TEST_F(CheckCommand, NamesWhatDisturbsAPressAndWhere)
{
  const test::Finished finished = check(holedBall().string() + " --unit mm");
  EXPECT_EQ(finished.code, 7) << finished.err;
  EXPECT_NE(finished.out.find("\nhole,2,"), std::string::npos) << finished.out;
  // STL has no way to share a point
  EXPECT_EQ(finished.out.find("duplicate point"), std::string::npos) << finished.out;
  EXPECT_EQ(finished.out.find("sliver"), std::string::npos) << finished.out;
  EXPECT_EQ(check(PALP_SHARE "/meshes/liver.vtp").code, 0);
}

TEST_F(CheckCommand, RepairsIntoAnotherFileOnly)
{
  const std::filesystem::path ball = holedBall();
  const std::string out = (folder_.path() / "whole.ply").string();
  const std::string line = ball.string() + " --unit mm --close-holes 30mm --repair ";
  const test::Finished finished = check(line + out);
  EXPECT_EQ(finished.code, 0) << finished.out << finished.err;
  EXPECT_NE(finished.out.find("2 holes closed"), std::string::npos) << finished.out;
  EXPECT_TRUE(readSurface(out, LengthUnit::Millimeter).closed);
  EXPECT_EQ(check(line + out).code, 2); // is there
  EXPECT_EQ(check(line + out + " --overwrite").code, 0);
  EXPECT_EQ(check(line + ball.string() + " --overwrite").code, 2); // is what is read
  EXPECT_EQ(check(line + (folder_.path() / "whole.txt").string()).code, 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2);
}

TEST_F(CheckCommand, SaysWhatRunSaysOfTheFile)
{
  const std::filesystem::path file = folder_.path() / "inches.obj";
  writeSurface(file, *makePolyData(makeSphere(0.002, 3).points, makeSphere(0.002, 3).triangles));
  const std::string text = check(file.string()).err; // 4 of some unit
  EXPECT_NE(
    text.find("warning: inches.obj: the file names no unit; cm is the only one"), std::string::npos)
    << text;
}

TEST_F(CheckCommand, AsksForTheUnitWhereTwoMayBeMeant)
{
  const test::Finished finished = check(holedBall().string()); // 60 of some unit
  EXPECT_EQ(finished.code, 2) << finished.err;
  EXPECT_NE(finished.err.find("more than one unit"), std::string::npos) << finished.err;
}

// writers of VTK for these leave a cut file, and say nothing
TEST_F(CheckCommand, OnAFullDiskTheFileBeforeStays)
{
  const std::string disk = (folder_.path() / "disk").string();
  std::filesystem::create_directory(disk);
  const std::string start = "unshare -rm sh -c 'mount -t tmpfs -o size=300k none " + disk;
  if (test::runCommand(start + "'").code != 0)
  {
    GTEST_SKIP() << "nothing may be mounted here";
  }
  for (const char* kind : { ".ply", ".obj", ".stl", ".vtp" })
  {
    const std::string file = disk + "/r" + kind;
    const test::Finished finished = test::runCommand(start + " && echo mine > " + file +
      " && " PALP_PROGRAM " check " PALP_SHARE "/meshes/liver.vtp --overwrite --repair " + file +
      "; echo code $?; ls " + disk + "; cat " + file + "'");
    EXPECT_NE(finished.out.find("code 2\nr" + std::string(kind) + "\nmine\n"), std::string::npos)
      << finished.out;
    EXPECT_NE(finished.err.find("cannot be written (No space left on device)"), std::string::npos)
      << finished.err;
    EXPECT_EQ(finished.err.find("ERR|"), std::string::npos) << finished.err;
  }
}

TEST(PhantomCommand, WarnsOfAPartThatIsThinnerThanItsVoxels)
{
  const test::TemporaryFolder folder;
  const auto warned = [&](const std::string& voxel)
  {
    return test::runCommand(
      PALP_PROGRAM " phantom slab --voxel " + voxel + " --out " + (folder.path() / voxel).string())
      .err;
  };
  EXPECT_NE(warned("3mm").find("warning: at this size of voxels skin has 0 of its volume"),
    std::string::npos);
  EXPECT_EQ(warned("1mm").find("warning"), std::string::npos);
}

TEST_F(CheckCommand, MarksTheFaultsOfTriangles)
{
  const std::string out = (folder_.path() / "faults.vtp").string();
  EXPECT_EQ(check(holedBall().string() + " --unit mm --faults " + out).code, 7);
  const std::string text = test::readAll(out);
  EXPECT_NE(text.find("Name=\"fault\""), std::string::npos);
}

TEST_F(CheckCommand, RefusesANameBeforeAnyWork)
{
  const std::string file = holedBall().string() + " --unit mm";
  const std::string out = folder_.path().string();
  for (const auto& [options, words] :
    { std::pair(" --repair " + out + "/x.xyz", out + "/x.xyz: not a kind of file written here"),
      { " --faults " + out + "/x.stl", "only .vtp has a place for faults" },
      { " --repair " + out + "/x.vtp --faults " + out + "/./x.vtp", "give two files" } })
  {
    const test::Finished run = check(file + options);
    EXPECT_EQ(run.code, 2) << options;
    EXPECT_NE(run.err.find(words), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  }
}

} // namespace
} // namespace palp
