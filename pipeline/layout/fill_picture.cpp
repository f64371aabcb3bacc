#include "pipeline/layout/fill_picture.h"

#include "haptics/units.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

// of the square, which is twice as wide at a distance of 1 as its half
double partOf(vtkPolyData& body, vtkCamera& camera, double half)
{
  const Eigen::Matrix4d view = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(
    camera.GetViewTransformMatrix()->GetData());
  double part = 0.0;
  for (vtkIdType i = 0; i < body.GetNumberOfPoints(); ++i)
  {
    Eigen::Vector4d point = Eigen::Vector4d::UnitW();
    body.GetPoint(i, point.data());
    const Eigen::Vector4d seen = view * point;
    part = std::max(part, std::max(std::abs(seen.x()), std::abs(seen.y())) / (-seen.z() * half));
  }
  return part;
}

} // namespace

void fillPicture(vtkRenderer& renderer, vtkPolyData& body)
{
  constexpr double kPart = 0.9;
  constexpr int kTimes = 3; // what is nearer grows faster
  vtkCamera& camera = *renderer.GetActiveCamera();
  const double half =
    renderer.GetTiledAspectRatio() * std::tan(0.5 * units::fromDegrees(camera.GetViewAngle()));
  for (int i = 0; i < kTimes; ++i)
  {
    camera.Dolly(kPart / partOf(body, camera, half));
  }
  renderer.ResetCameraClippingRange();
}

} // namespace palp
