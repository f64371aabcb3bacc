#include "haptics/error.h"
#include "haptics/units.h"
#include "pipeline/poly_data.h"
#include "pipeline/surface_io.h"
#include "tests/support/process.h"

#include <Eigen/Geometry>
#include <fstream>
#include <gtest/gtest.h>
#include <numbers>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageWriter.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLImageDataWriter.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kRadiusMm = 30.0;
const Vector3d kCenterMm(40.0, 50.0, 45.0);

// distance to a ball [mm], or 1 inside it and 0 outside; voxels of 2 x 2.5 x 3 mm
vtkSmartPointer<vtkImageData> ball(bool mask)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(41, 41, 31);
  image->SetSpacing(2.0, 2.5, 3.0);
  image->AllocateScalars(mask ? VTK_UNSIGNED_CHAR : VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double distance = (Vector3d(image->GetPoint(i)) - kCenterMm).norm() - kRadiusMm;
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, mask ? (distance < 0.0 ? 1.0 : 0.0) : distance);
  }
  return image;
}

class Images : public testing::Test
{
protected:
  template <typename Writer>
  std::filesystem::path write(const std::string& name, vtkImageData& image, vtkMatrix4x4* form = {})
  {
    const std::filesystem::path file = folder_.path() / name;
    vtkNew<Writer> writer;
    if constexpr (std::is_same_v<Writer, vtkMetaImageWriter>)
    {
      writer->SetCompression(false);
    }
    if constexpr (std::is_same_v<Writer, vtkNIFTIImageWriter>)
    {
      writer->SetQFormMatrix(form);
      writer->SetSFormMatrix(form);
    }
    writer->SetFileName(file.c_str());
    writer->SetInputData(&image);
    writer->Write();
    return file;
  }

  std::string refusal(const std::filesystem::path& file, std::optional<double> level)
  {
    try
    {
      (void)readSurface(file, {}, level);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  TemporaryFolder folder_;
};

// largest distance from the ball's surface [mm]
double farthest(vtkPolyData& mesh, const Vector3d& centerMm)
{
  double most = 0.0;
  for (const Vector3d& point : pointsOf(mesh))
  {
    most = std::max(most, std::abs((point * 1e3 - centerMm).norm() - kRadiusMm));
  }
  return most;
}

// volume by the divergence theorem [mm^3]
double volumeMm3(vtkPolyData& mesh)
{
  const std::vector<Vector3d> points = pointsOf(mesh);
  double sum = 0.0;
  for (const Triangle& t : trianglesOf(mesh))
  {
    const auto at = [&](int k) -> const Vector3d&
    { return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum * 1e9;
}

TEST_F(Images, TheLevelOfADistanceIsTheBall)
{
  const auto image = ball(false);
  for (const auto& file : { write<vtkMetaImageWriter>("ball.mha", *image),
         write<vtkXMLImageDataWriter>("ball.vti", *image) })
  {
    const LoadedSurface surface = readSurface(file, {}, 0.0);
    EXPECT_TRUE(surface.closed) << file;
    EXPECT_EQ(surface.unit, LengthUnit::Millimetre);
    EXPECT_LT(farthest(*surface.mesh, kCenterMm), 0.2) << file; // a tenth of a voxel
  }
}

TEST_F(Images, AMaskLosesItsStairsAndKeepsItsVolume)
{
  const auto file = write<vtkMetaImageWriter>("mask.mha", *ball(true));
  const LoadedSurface surface = readSurface(file, {}, 0.5);
  EXPECT_TRUE(surface.closed);
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2); // half the diagonal of a voxel
  const double exact = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadiusMm, 3);
  EXPECT_NEAR(volumeMm3(*surface.mesh), exact, 0.02 * exact);
}

TEST_F(Images, NiftiStandsWhereItsHeaderSaysInAxesToLeftBackAndHead)
{
  // a quarter turn about the head's axis, and a shift, into right, front, head
  vtkNew<vtkMatrix4x4> form;
  const double values[16] = { 0, -1, 0, 7, 1, 0, 0, -9, 0, 0, 1, 11, 0, 0, 0, 1 };
  form->DeepCopy(values);
  const auto file = write<vtkNIFTIImageWriter>("ball.nii.gz", *ball(false), form);
  const LoadedSurface surface = readSurface(file, {}, 0.0);
  const Vector3d ras(-kCenterMm.y() + 7, kCenterMm.x() - 9, kCenterMm.z() + 11);
  EXPECT_LT(farthest(*surface.mesh, { -ras.x(), -ras.y(), ras.z() }), 0.2);
  EXPECT_GT(volumeMm3(*surface.mesh), 0.0); // turned outwards
}

TEST_F(Images, OnlyTheLargestPieceIsTaken)
{
  const auto image = ball(true);
  image->SetScalarComponentFromDouble(1, 1, 1, 0, 1.0);
  const LoadedSurface surface =
    readSurface(write<vtkMetaImageWriter>("speck.mha", *image), {}, 0.5);
  EXPECT_LT(farthest(*surface.mesh, kCenterMm), 2.2);
}

TEST_F(Images, RefusesWithTheValuesThatThereAre)
{
  const auto mask = write<vtkMetaImageWriter>("mask.mha", *ball(true));
  EXPECT_NE(refusal(mask, {}).find("name the value of the surface with a level, its values go from "
                                   "0 to 1"),
    std::string::npos);
  EXPECT_NE(refusal(mask, 3.0).find("no surface at level 3"), std::string::npos);
  const std::filesystem::path stl = folder_.path() / "a.stl";
  std::ofstream(stl) << "solid a\nendsolid a\n";
  EXPECT_NE(refusal(stl, 1.0).find("leave the level out"), std::string::npos);

  std::string turned = readAll(mask);
  const std::string axes = "TransformMatrix = 1 0 0 0 1 0 0 0 1";
  const std::size_t at = turned.find(axes);
  ASSERT_NE(at, std::string::npos);
  turned.replace(at, axes.size(), "TransformMatrix = 0 1 0 1 0 0 0 0 1");
  const std::filesystem::path file = folder_.path() / "turned.mha";
  std::ofstream(file, std::ios::binary) << turned;
  EXPECT_NE(refusal(file, 0.5).find("its axes are turned"), std::string::npos);
}

TEST_F(Images, ADamagedImageIsRefusedInOneSentence)
{
  const auto image = ball(true);
  for (const auto& whole :
    { write<vtkMetaImageWriter>("a.mha", *image), write<vtkNIFTIImageWriter>("a.nii", *image),
      write<vtkNIFTIImageWriter>("a.nii.gz", *image),
      write<vtkXMLImageDataWriter>("a.vti", *image) })
  {
    const std::string bytes = readAll(whole);
    for (const double part : { 0.01, 0.3, 0.9 })
    {
      const std::filesystem::path cut = folder_.path() / ("cut_" + whole.filename().string());
      std::ofstream(cut, std::ios::binary)
        << bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size())));
      const std::string message = refusal(cut, 0.5);
      EXPECT_NE(message, "accepted") << cut << ' ' << part;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

} // namespace
} // namespace palp::test
