#include "tests/support/deflated.h"
#include "tests/support/process.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <map>

// what users give by mistake, or a disk gives back: one sentence, exit code 2, nothing written

namespace palp::test
{
namespace
{

constexpr int kSide = 12;
constexpr std::size_t kVoxels = kSide * kSide * kSide;

std::string metaHeader(const std::map<std::string, std::string>& changed)
{
  std::string text;
  for (const auto& [key, usual] :
    { std::pair<std::string, std::string>{ "NDims", "3" }, { "BinaryDataByteOrderMSB", "False" },
      { "ElementSpacing", "5 5 5" }, { "DistanceUnits", "mm" }, { "Offset", "0 0 0" },
      { "DimSize", "12 12 12" }, { "ElementNumberOfChannels", "1" }, { "ElementType", "MET_UCHAR" },
      { "ElementDataFile", "LOCAL" } })
  {
    const auto found = changed.find(key);
    text += key + " = " + (found == changed.end() ? usual : found->second) + "\n";
  }
  return text;
}

std::string nrrdHeader(const std::string& type, const std::string& axes, const std::string& more)
{
  return "NRRD0004\ntype: " + type + "\n" + axes +
    "space: left-posterior-superior\nspace origin: (0,0,0)\n" + more + "\n\n";
}

class BadImages : public testing::Test
{
protected:
  // both commands, with what makes a surface of a good one
  void expectRefusal(const std::string& name, const std::string& bytes, const std::string& words,
    const std::string& part = "--label 1")
  {
    const std::filesystem::path file = folder_.path() / "in" / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    for (const std::string command : { "import", "run --at 0,0,0" })
    {
      const std::filesystem::path out = folder_.path() / "out";
      const Finished finished = runCommand(
        PALP_PROGRAM " " + command + " " + file.string() + " " + part + " --out " + out.string());
      EXPECT_EQ(finished.code, 2) << command << name << finished.err;
      EXPECT_NE(finished.err.find(words), std::string::npos) << name << ": " << finished.err;
      EXPECT_EQ(sentences(finished).size(), 1U) << finished.err;
      EXPECT_FALSE(std::filesystem::exists(out)) << command << name;
    }
  }

  // a block of label 1 in the middle
  static std::string voxels()
  {
    std::string bytes;
    for (std::size_t i = 0; i < kVoxels; ++i)
    {
      const auto isMiddle = [](std::size_t index) { return index > 2 && index < 9; };
      bytes += isMiddle(i % kSide) && isMiddle(i / kSide % kSide) && isMiddle(i / kSide / kSide)
        ? '\1'
        : '\0';
    }
    return bytes;
  }

  TemporaryFolder folder_;
};

TEST_F(BadImages, ThatAreCutOffOrDamaged)
{
  expectRefusal("empty.nii", "", "empty");
  expectRefusal("cut.mha", metaHeader({}) + voxels().substr(0, 900), "cut off");
  expectRefusal("more.mha", metaHeader({}) + voxels() + "more", "more than");
  const std::string axes = "dimension: 3\nsizes: 12 12 12\nspace directions: (5,0,0) (0,5,0) "
                           "(0,0,5)\n";
  std::string packed = deflated(voxels(), MAX_WBITS + 16);
  packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 0x5A);
  expectRefusal("packed.nrrd", nrrdHeader("uchar", axes, "encoding: gzip") + packed, "damaged");
  expectRefusal("endian.nrrd",
    nrrdHeader("ushort", axes, "endian: middle\nencoding: raw") + voxels() + voxels(),
    "its endian");
}

TEST_F(BadImages, ThatAreNoVolumeOfOneValue)
{
  expectRefusal("rgb.mha",
    metaHeader({ { "ElementNumberOfChannels", "3" } }) + voxels() + voxels() + voxels(),
    "several values at each voxel");
  expectRefusal("time.nrrd",
    nrrdHeader("uchar",
      "dimension: 4\nsizes: 12 12 12 2\nspace directions: (5,0,0) (0,5,0) (0,0,5) none\n",
      "encoding: raw") +
      voxels() + voxels(),
    "an image of 4 axes");
  expectRefusal("other.mha", metaHeader({}) + voxels(), "no label 7 in it", "--label 7");
  std::string few = voxels();
  std::ranges::fill(few, '\0');
  few[900] = '\1';
  expectRefusal("one.mha", metaHeader({}) + few, "has 1 voxel, too few");
  std::ranges::fill(few, '\0');
  expectRefusal("none.mha", metaHeader({}) + few, "no body in it, all its voxels are 0", "");
}

TEST_F(BadImages, ThatClaimTooMuchOrReachOutside)
{
  expectRefusal(
    "huge.mha", metaHeader({ { "DimSize", "20000 20000 5000" } }) + voxels(), "cut off");
  expectRefusal("huge.vti",
    "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 5999999 0 49 0 39\" "
    "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 5999999 0 49 0 39\">"
    "<PointData Scalars=\"s\"><DataArray type=\"UInt8\" Name=\"s\" format=\"ascii\">1 2 3"
    "</DataArray></PointData></Piece></ImageData></VTKFile>",
    "counts more than there is memory for");
  expectRefusal("components.mha",
    metaHeader({ { "ElementNumberOfChannels", "1000000000" } }) + voxels(), "several values");
  expectRefusal("far.mha", metaHeader({ { "Offset", "1e300 0 0" } }) + voxels(),
    "the origin in its header is 1e+300 away");
  std::ofstream(folder_.path() / "outside.raw", std::ios::binary) << voxels();
  expectRefusal("outside.mhd", metaHeader({ { "ElementDataFile", "../outside.raw" } }), "outside");
  expectRefusal("outside.nhdr",
    nrrdHeader("uchar",
      "dimension: 3\nsizes: 12 12 12\nspace directions: (5,0,0) (0,5,0) (0,0,5)\n",
      "encoding: raw\ndata file: ../outside.raw"),
    "not beside it");
}

TEST_F(BadImages, OfVoxelsThatAreNoNumbers)
{
  std::string bytes;
  for (std::size_t i = 0; i < kVoxels; ++i)
  {
    const float value =
      i == 700 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(i % 100);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  expectRefusal("nan.mha", metaHeader({ { "ElementType", "MET_FLOAT" } }) + bytes,
    "no numbers (NaN or infinite): 1", "--level 50");
}

} // namespace
} // namespace palp::test
