#pragma once

#include "haptics/error.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/support/process.h"

#include <Eigen/Geometry>
#include <fstream>
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMetaImageWriter.h>
#include <vtkNIFTIImageWriter.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp::test
{

inline constexpr double kRadiusMm = 30.0;
inline const Eigen::Vector3d kCenterMm(40.0, 50.0, 45.0);

/// Distance to a ball [mm], or 1 inside it and 0 outside; voxels of 2 x 2.5 x 3 mm
inline vtkSmartPointer<vtkImageData> ball(bool mask)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(41, 41, 31);
  image->SetSpacing(2.0, 2.5, 3.0);
  image->AllocateScalars(mask ? VTK_UNSIGNED_CHAR : VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double distance = (Eigen::Vector3d(image->GetPoint(i)) - kCenterMm).norm() - kRadiusMm;
    image->GetPointData()->GetScalars()->SetComponent(
      i, 0, mask ? (distance < 0.0 ? 1.0 : 0.0) : distance);
  }
  return image;
}

/// Images in a folder of their own.
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

  std::string refusal(const std::filesystem::path& file, const ImagePart& part)
  {
    try
    {
      (void)readSurface(file, {}, part);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "accepted";
  }

  std::filesystem::path write(const std::string& name, const std::string& bytes)
  {
    const std::filesystem::path file = folder_.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

  TemporaryFolder folder_;
};

/// Largest distance from the ball's surface [mm]
inline double farthest(vtkPolyData& mesh, const Eigen::Vector3d& centerMm)
{
  double most = 0.0;
  for (const Eigen::Vector3d& point : pointsOf(mesh))
  {
    most = std::max(most, std::abs((point * 1e3 - centerMm).norm() - kRadiusMm));
  }
  return most;
}

/// Volume by the divergence theorem [mm^3]
inline double volumeMm3(vtkPolyData& mesh)
{
  const std::vector<Eigen::Vector3d> points = pointsOf(mesh);
  double sum = 0.0;
  for (const Triangle& t : trianglesOf(mesh))
  {
    const auto at = [&](int k) -> const Eigen::Vector3d&
    { return points[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum * 1e9;
}

} // namespace palp::test
