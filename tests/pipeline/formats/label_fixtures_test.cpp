#include "pipeline/surface_io/surface_io.h"
#include "tests/pipeline/formats/label_maps.h"
#include "tests/support/deflated.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkXMLImageDataWriter.h>

// every form of a label map, read back against the balls that it was made of

namespace palp::test
{
namespace
{

class LabelFixtures : public testing::Test
{
protected:
  void write(const std::string& name, const std::string& bytes)
  {
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }

  void writeVti(const std::string& name, const Grid& grid, const std::array<int, 3>& first)
  {
    vtkNew<vtkImageData> image;
    const Vector3i last = Vector3i(first.data()) + grid.size - Vector3i::Ones();
    image->SetExtent(first[0], last.x(), first[1], last.y(), first[2], last.z());
    image->SetSpacing(grid.side.data());
    vtkNew<vtkMatrix3x3> axes;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        axes->SetElement(i, k, grid.axes(i, k));
      }
    }
    image->SetDirectionMatrix(axes);
    const Vector3d origin = grid.at(-Vector3i(first.data()).cast<double>());
    image->SetOrigin(origin.data());
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    const std::string voxels = voxelsOf<std::uint8_t>(grid);
    std::memcpy(image->GetScalarPointer(), voxels.data(), voxels.size());
    vtkNew<vtkXMLImageDataWriter> writer;
    writer->SetFileName((folder_.path() / name).c_str());
    writer->SetInputData(image);
    writer->Write();
  }

  static std::string packed(const std::string& bytes)
  {
    constexpr int kGzip = 16;
    return deflated(bytes, MAX_WBITS + kGzip);
  }

  // each ball where it is, as large as its voxels and as round as they allow
  void expectBalls(const std::string& name, const Grid& grid, bool areLayers = false)
  {
    const FileOrgans found = readFileOrgans(folder_.path() / name, {}, false);
    ASSERT_EQ(found.organs.size(), 2U) << name;
    const Balls balls(grid);
    const double voxel = grid.side.cwiseAbs().prod();
    for (std::size_t ball = 0; ball < 2; ++ball)
    {
      const FileOrgan& organ = found.organs[ball];
      const bool isWhole = areLayers || ball == 1;
      std::uint64_t count = 0;
      eachVoxel(grid,
        [&](const Vector3d& place)
        { count += balls.isIn(ball, place) && (isWhole || !balls.isIn(1, place)); });
      EXPECT_EQ(organ.voxels, count) << name;
      const auto [volume, middle] = contentOf(organ.surface, balls.centers[ball]);
      EXPECT_NEAR(volume / (static_cast<double>(count) * voxel), 1.0, 0.01) << name;
      if (isWhole)
      {
        EXPECT_LT(middle.norm(), 0.1 * grid.side.cwiseAbs().minCoeff()) << name;
        EXPECT_LT(
          roughness(organ.surface, balls.centers[ball], balls.radii[ball]), 0.35 * std::cbrt(voxel))
          << name;
      }
    }
  }

  // volume, and its middle from a place, by the divergence theorem
  static std::pair<double, Vector3d> contentOf(const FileSurface& surface, const Vector3d& from)
  {
    double volume = 0.0;
    Vector3d moment = Vector3d::Zero();
    for (const auto& [i, j, k] : surface.triangles)
    {
      const Vector3d a = surface.points[at(i)] - from;
      const Vector3d b = surface.points[at(j)] - from;
      const Vector3d c = surface.points[at(k)] - from;
      const double part = a.dot(b.cross(c)) / 6.0;
      volume += part;
      moment += 0.25 * part * (a + b + c);
    }
    return { volume, moment / volume };
  }

  // root mean square distance from a ball's surface
  static double roughness(const FileSurface& surface, const Vector3d& center, double radius)
  {
    double squares = 0.0;
    for (const Vector3d& point : surface.points)
    {
      squares += std::pow((point - center).norm() - radius, 2);
    }
    return std::sqrt(squares / static_cast<double>(surface.points.size()));
  }

  TemporaryFolder folder_;
};

TEST_F(LabelFixtures, OfNiftiAreTheBalls)
{
  const Grid straight{ .origin = { -31.0, 12.5, 800.0 } };
  write("straight.nii", nifti(straight, 2, 8, voxelsOf<std::uint8_t>(straight), false, false));
  expectBalls("straight.nii", straight);

  const Grid turned{ .axes = oblique(), .origin = { 12.0, -7.0, -300.0 } };
  write("oblique.nii", nifti(turned, 512, 16, voxelsOf<std::uint16_t>(turned, true), true, false));
  expectBalls("oblique.nii", turned);

  // to left, front and head: a mirror, which a quaternion tells by the sign of pixdim[0]
  const Grid las{ .axes = signs(1, -1, 1), .origin = { 3.0, 90.0, 20.0 } };
  write("las.nii.gz", packed(nifti(las, 4, 16, voxelsOf<std::int16_t>(las), false, true)));
  expectBalls("las.nii.gz", las);
}

TEST_F(LabelFixtures, OfMetaImageAreTheBalls)
{
  const Grid turned{ .axes = oblique(), .origin = { 100.0, -50.0, 25.0 } };
  write("oblique.mha", meta(turned, "MET_UCHAR", false, voxelsOf<std::uint8_t>(turned), "LOCAL"));
  expectBalls("oblique.mha", turned);

  const Grid mirrored{ .axes = signs(-1, -1, 1), .origin = { 60.0, 80.0, -9.0 } };
  write("beside.raw", voxelsOf<std::int16_t>(mirrored, true));
  write("beside.mhd", meta(mirrored, "MET_SHORT", true, "", "beside.raw"));
  expectBalls("beside.mhd", mirrored);

  // against its directions, as some scanners' programs write it and ITK reads it
  const Grid backward{
    .side = { 1.5, -2.0, -2.5 }, .axes = oblique(), .origin = { -20.0, 7.0, 300.0 }
  };
  write("back.mha", meta(backward, "MET_UCHAR", false, voxelsOf<std::uint8_t>(backward), "LOCAL"));
  expectBalls("back.mha", backward);
}

TEST_F(LabelFixtures, OfNrrdAreTheBalls)
{
  const Grid turned{ .axes = oblique(), .origin = { -80.0, 44.0, 5.0 } };
  write("oblique.nrrd",
    nrrd(turned, "left-posterior-superior", Matrix3d::Identity(), "type: uchar\nencoding: raw",
      voxelsOf<std::uint8_t>(turned)));
  expectBalls("oblique.nrrd", turned);

  const Grid ras{ .axes = signs(-1, -1, 1), .origin = { 40.0, 30.0, 20.0 } };
  write("ras.nrrd",
    nrrd(ras, "right-anterior-superior", signs(-1, -1, 1),
      "type: ushort\nendian: big\nencoding: gzip", packed(voxelsOf<std::uint16_t>(ras, true))));
  expectBalls("ras.nrrd", ras);

  // readers that take an axis of four for colors lose it
  const Grid thin{ .size = { 4, 60, 56 }, .side = { 12.0, 1.0, 1.0 } };
  write("thin.nrrd",
    nrrd(thin, "left-posterior-superior", Matrix3d::Identity(), "type: uchar\nencoding: raw",
      voxelsOf<std::uint8_t>(thin)));
  const FileOrgans found = readFileOrgans(folder_.path() / "thin.nrrd", {}, true);
  vtkIdType both = 0;
  const Balls balls(thin);
  eachVoxel(
    thin, [&](const Vector3d& place) { both += balls.isIn(0, place) || balls.isIn(1, place); });
  ASSERT_EQ(found.organs.size(), 2U);
  EXPECT_EQ(found.organs[0].voxels + found.organs[1].voxels, static_cast<std::uint64_t>(both));
}

TEST_F(LabelFixtures, OfLayersThatOverlapAreBothBallsWhole)
{
  const Grid las{ .axes = signs(1, -1, 1), .origin = { 5.0, 66.0, -12.0 } };
  const std::string segments =
    "type: uchar\nencoding: gzip\nSegment0_Name:=large\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment0_Color:=1 0.5 0\nSegment1_Name:=small\nSegment1_LabelValue:=1\nSegment1_Layer:=1\n"
    "Segment1_Color:=0.2 0.4";
  write("two.seg.nrrd",
    nrrd(las, "left-anterior-superior", signs(1, -1, 1), segments, packed(layersOf(las))));
  expectBalls("two.seg.nrrd", las, true);
  const FileOrgans found = readFileOrgans(folder_.path() / "two.seg.nrrd", {}, true);
  EXPECT_EQ(found.organs[0].color, "#ff8000");
  EXPECT_EQ(found.organs[1].color, "") << "two numbers are no color";
  // as 3D Slicer wrote them to 4.10
  const std::string old =
    "type: uchar\nencoding: gzip\n# no Layer\nSegment0_Name:=large\nSegment1_Name:=small";
  write("old.seg.nrrd",
    nrrd(las, "left-anterior-superior", signs(1, -1, 1), old, packed(layersOf(las))));
  expectBalls("old.seg.nrrd", las, true);
}

TEST_F(LabelFixtures, AreCalledAsATableCallsThemWhateverTheFileDoes)
{
  const Grid las{ .axes = signs(1, -1, 1), .origin = { 5.0, 66.0, -12.0 } };
  const std::string own = "type: uchar\nencoding: gzip\nSegment0_Name:=large\n"
                          "Segment0_LabelValue:=1";
  write("own.seg.nrrd",
    nrrd(las, "left-anterior-superior", signs(1, -1, 1), own, packed(voxelsOf<std::uint8_t>(las))));
  const ImagePart table{ .names = { { 1.0, "liver" }, { 2.0, "kidney" } } };
  const auto named = readFileOrgans(folder_.path() / "own.seg.nrrd", table, true);
  ASSERT_EQ(named.organs.size(), 2U);
  EXPECT_EQ(named.organs[0].name, "liver");
  EXPECT_EQ(named.organs[1].name, "kidney");

  const std::string layers = "type: uchar\nencoding: gzip\nSegment0_Name:=large\n"
                             "Segment0_LabelValue:=1\nSegment0_Layer:=0\nSegment1_Name:=small\n"
                             "Segment1_LabelValue:=1\nSegment1_Layer:=1";
  write("layers.seg.nrrd",
    nrrd(las, "left-anterior-superior", signs(1, -1, 1), layers, packed(layersOf(las))));
  const FileOrgans kept = readFileOrgans(folder_.path() / "layers.seg.nrrd", table, true);
  ASSERT_EQ(kept.organs.size(), 2U);
  EXPECT_EQ(kept.organs[0].name + kept.organs[1].name, "largesmall");
  const auto tells = [](const std::string& note)
  { return note.find("1 is the value of several segments") != note.npos; };
  EXPECT_TRUE(std::ranges::any_of(kept.notes, tells));
}

TEST_F(LabelFixtures, OfVtiAreTheBalls)
{
  const Grid turned{ .axes = oblique(), .origin = { 33.0, -21.0, 7.0 } };
  writeVti("extent.vti", turned, { 12, -7, 100 });
  expectBalls("extent.vti", turned);

  const Grid backward{ .side = { 1.5, -2.0, 2.5 }, .origin = { 0.0, 90.0, -40.0 } };
  writeVti("backward.vti", backward, { 0, 0, 0 });
  expectBalls("backward.vti", backward);
}

} // namespace
} // namespace palp::test
