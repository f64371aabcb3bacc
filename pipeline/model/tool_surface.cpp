#include "pipeline/model/tool_surface.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

namespace palp
{

vtkSmartPointer<vtkPolyData> revolved(std::span<const Eigen::Vector2d> profile, int sides)
{
  constexpr double kCrease = 50.0; // [deg] an edge, not a curve
  const std::span<const Eigen::Vector2d> around = profile.subspan(1, profile.size() - 2);
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, profile.front().y());
  for (const Eigen::Vector2d& at : around)
  {
    for (int k = 0; k < sides; ++k)
    {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      points->InsertNextPoint(at.x() * std::cos(angle), at.x() * std::sin(angle), at.y());
    }
  }
  const vtkIdType top = points->InsertNextPoint(0.0, 0.0, profile.back().y());

  vtkNew<vtkCellArray> triangles;
  const auto rings = static_cast<vtkIdType>(around.size());
  for (vtkIdType k = 0; k < sides; ++k)
  {
    const vtkIdType next = (k + 1) % sides;
    triangles->InsertNextCell({ 0, 1 + next, 1 + k });
    for (vtkIdType ring = 0; ring + 1 < rings; ++ring)
    {
      const vtkIdType low = 1 + ring * sides;
      const vtkIdType high = low + sides;
      triangles->InsertNextCell({ low + k, low + next, high + next });
      triangles->InsertNextCell({ low + k, high + next, high + k });
    }
    const vtkIdType last = 1 + (rings - 1) * sides;
    triangles->InsertNextCell({ last + k, last + next, top });
  }
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(surface);
  normals->SetFeatureAngle(kCrease);
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

vtkSmartPointer<vtkPolyData> toolSurface(const Tip& tip, double length)
{
  constexpr int kRings = 32;
  // the profile, closer where a sphere's flank is steep, then the shaft and its end
  const double base = baseRadius(tip);
  std::vector<Eigen::Vector2d> profile{ Eigen::Vector2d::Zero() };
  for (int i = 1; i <= kRings; ++i)
  {
    const double radius = base * std::sin(0.5 * std::numbers::pi * i / kRings);
    profile.emplace_back(radius, tipHeight(tip, radius));
  }
  const double end = profile.back().y() + length;
  profile.emplace_back(base, end);
  profile.emplace_back(0.0, end);
  return revolved(profile);
}

} // namespace palp
