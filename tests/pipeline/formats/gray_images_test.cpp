#include "haptics/surface/area_and_volume.h"
#include "tests/pipeline/formats/ball_images.h"

#include <array>
#include <vtkMarchingCubes.h>
#include <vtkXMLImageDataWriter.h>

// of scans, whose values tell where between voxels a surface is: nothing that smooths may move it

namespace palp::test
{
namespace
{

using Eigen::Vector3d;

// of a scan as wide as a body, at its ends
TEST_F(Images, BallsFarApartStayWhereTheyAre)
{
  constexpr double kRadius = 11.0; // [voxels]
  const std::array centers{ Vector3d(15.2, 19.7, 20.4), Vector3d(404.9, 20.3, 18.8) };
  vtkNew<vtkImageData> image;
  image->SetDimensions(420, 40, 40);
  image->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const Vector3d place(image->GetPoint(i));
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, kRadius - std::min((place - centers[0]).norm(), (place - centers[1]).norm()));
  }
  const auto file = write<vtkXMLImageDataWriter>("two.vti", *image);
  const auto surface =
    readSurface(file, LengthUnit::Millimeter, { .level = 0.0, .labels = {}, .components = 2 });
  for (const Vector3d& point : pointsOf(*surface.mesh))
  {
    const Vector3d& center = centers[1e3 * point.x() < 210.0 ? 0 : 1];
    ASSERT_NEAR((1e3 * point - center).norm(), kRadius, 0.1) << 1e3 * point.transpose();
  }
}

// walls hardly thicker than a voxel: as much lies between them as another program finds
TEST_F(Images, AThinWallKeepsItsVolume)
{
  for (const double wall : { 1.2, 1.6, 2.5 }) // [voxels]
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(52, 52, 52);
    image->AllocateScalars(VTK_FLOAT, 1);
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double off = (Vector3d(image->GetPoint(i)) - Vector3d(25.3, 25.6, 25.1)).norm() - 20.0;
      image->GetPointData()->GetScalars()->SetComponent(i, 0, 0.5 * wall - std::abs(off));
    }
    vtkNew<vtkMarchingCubes> cubes;
    cubes->SetInputData(image);
    cubes->SetValue(0, 0.0);
    cubes->Update();
    vtkPolyData& expected = *cubes->GetOutput();
    const double volume = std::abs(enclosedVolume(pointsOf(expected), trianglesOf(expected)));
    const auto surface = readSurface(write<vtkXMLImageDataWriter>("wall.vti", *image),
      LengthUnit::Millimeter, { .level = 0.0, .labels = {} });
    EXPECT_NEAR(1e9 * enclosedVolume(pointsOf(*surface.mesh), trianglesOf(*surface.mesh)), volume,
      0.01 * volume)
      << wall;
  }
}

} // namespace
} // namespace palp::test
