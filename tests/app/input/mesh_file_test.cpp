#include "app/input/mesh_file.h"

#include "tests/support/process.h"

#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

// by sha256sum
TEST(MeshFile, HashCoversTheDataBesideAHeader)
{
  const test::TemporaryFolder folder;
  const auto shell = [&](const std::string& command)
  { return test::runCommand("cd " + folder.path().string() + " && " + command).out.substr(0, 64); };
  std::ofstream(folder.path() / "a.mhd") << "NDims = 3\r\nElementDataFile =  a.raw \r\n";
  std::ofstream(folder.path() / "a.raw") << "voxels";
  const MeshFile before = describeFile(folder.path() / "a.mhd");
  EXPECT_EQ(before.sha256, shell("cat a.mhd a.raw | sha256sum"));
  std::ofstream(folder.path() / "a.raw") << "voxelS";
  EXPECT_NE(describeFile(folder.path() / "a.mhd").sha256, before.sha256);
  std::ofstream(folder.path() / "b.mhd") << "ElementDataFile = LOCAL\nvoxels";
  EXPECT_EQ(describeFile(folder.path() / "b.mhd").sha256, shell("sha256sum b.mhd"));
  std::ofstream(folder.path() / "c.stl") << "ElementDataFile = a.raw\n";
  EXPECT_EQ(describeFile(folder.path() / "c.stl").sha256, shell("sha256sum c.stl"));
}

TEST(MeshFile, TellsTheAxesThatAllHave)
{
  const MeshFile patient{ .name = "a.nii", .sha256 = {}, .unit = "mm", .space = "LPS", .part = {} };
  MeshFile moved = patient;
  moved.moved = true;
  MeshFile unknown = patient;
  unknown.space.clear();
  EXPECT_EQ(spaceOf({ patient, patient }), "LPS");
  EXPECT_EQ(spaceOf({ patient, moved }), "");
  EXPECT_EQ(spaceOf({ patient, unknown }), "");
  EXPECT_EQ(spaceOf({}), "");
}

} // namespace
} // namespace palp
