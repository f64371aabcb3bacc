#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/ball_images.h"
#include "tests/support/label_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

// one grid as several formats write it: what is made of it goes by its voxels alone

namespace palp::test
{
namespace
{

using Eigen::Array3d;
using Eigen::Vector3d;

// a ball of 22 mm in the middle of 60 mm, in bytes
std::string ballIn(const Array3d& sides, const Eigen::Array3i& size)
{
  std::string voxels;
  for (int i = 0; i < size.prod(); ++i)
  {
    const Array3d index(i % size[0], i / size[0] % size[1], i / size[0] / size[1]);
    const Array3d off = sides * index - 30.2;
    voxels += off.matrix().norm() <= 22.0 ? '\1' : '\0';
  }
  return voxels;
}

TEST_F(Images, OfLongVoxelsAreOneSurfaceInEveryFormat)
{
  for (const int axis : { 0, 1, 2 })
  {
    Array3d sides = Array3d::Ones();
    sides[axis] = 3.0;
    const Eigen::Array3i size = (60.0 / sides).ceil().cast<int>();
    std::ostringstream nrrd;
    std::ostringstream meta;
    nrrd << "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: "
         << size.transpose() << "\nspace directions: (" << sides[0] << ",0,0) (0," << sides[1]
         << ",0) (0,0," << sides[2] << ")\nencoding: raw\nspace origin: (0,0,0)\n\n"
         << ballIn(sides, size);
    meta << "NDims = 3\nAnatomicalOrientation = RAI\nElementSpacing = " << sides.transpose()
         << "\nDimSize = " << size.transpose()
         << "\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
         << ballIn(sides, size);
    std::array<FileOrgan, 2> organs;
    std::ranges::transform(std::array{ write("a.nrrd", nrrd.str()), write("a.mha", meta.str()) },
      organs.begin(),
      [](const auto& file) { return readFileOrgans(file, {}, false).organs.at(0); });
    ASSERT_EQ(organs[0].surface.points.size(), organs[1].surface.points.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < organs[0].surface.points.size(); ++i)
    {
      const Vector3d& point = organs[0].surface.points[i];
      ASSERT_LT((point - organs[1].surface.points[i]).norm(), 1e-4) << axis;
      sum += std::pow((point.array() - 30.2).matrix().norm() - 22.0, 2);
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(organs[0].surface.points.size())), 0.35) << axis;
    for (const FileOrgan& organ : organs)
    {
      EXPECT_EQ(organ.surface.unit, "mm"); // of 60 mm, which may as well be 600
      const auto warns = [](const std::string& note)
      { return note.find("3 times as long as they are wide") != note.npos; };
      EXPECT_TRUE(std::ranges::any_of(organ.surface.notes, warns)) << axis;
    }
  }
}

// of two layers, the second with two values that the header says nothing of
TEST_F(Images, ValuesOfALayerThatNoSegmentNamesAreBodies)
{
  const auto file = writeLayers(folder_.path() / "a.seg.nrrd", 5,
    "Segment0_Name:=liver\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n",
    [](int i) {
      return std::string{ i < 16 ? '\1' : '\0', i < 40 ? '\1' : '\7' };
    });
  const FileOrgans found = readFileOrgans(file, {}, true);
  std::vector<std::pair<std::string, std::uint64_t>> labels;
  for (const FileOrgan& organ : found.organs)
  {
    labels.emplace_back(organ.label + organ.name, organ.voxels);
  }
  const decltype(labels) expected{ { "1liver", 16 }, { "1", 40 }, { "7", 24 } };
  EXPECT_EQ(labels, expected);
}

} // namespace
} // namespace palp::test
