#include "app/check/panel/fault_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vtkCellArray.h>
#include <vtkMapper.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace palp
{
namespace
{

struct Style
{
  appearance::Color color;
  float size;     // of a point [pixels]
  double forward; // of a point, in units of the depth buffer
};
constexpr std::array<Style, 3> kStyles{ { { FaultMarks::kColor, 7.0F, -200.0 },
  { appearance::kInk, 20.0F, -600.0 }, { FaultMarks::kColor, 14.0F, -700.0 } } };

void addPoint(const Eigen::Vector3d& place, vtkPoints& points, vtkCellArray& dots)
{
  const vtkIdType point = points.InsertNextPoint(place.data());
  dots.InsertNextCell(1, &point);
}

// on both sides of the surface, as nobody knows on which it is looked at
void addTriangle(const FaultMarks::Corners& corners, double lift, vtkPoints& points,
  vtkCellArray& triangles, vtkCellArray& dots)
{
  const Eigen::Vector3d up =
    lift * (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  for (const Eigen::Vector3d& aside : { up, Eigen::Vector3d(-up) })
  {
    triangles.InsertNextCell(3);
    for (const Eigen::Vector3d& corner : corners)
    {
      triangles.InsertCellPoint(points.InsertNextPoint(Eigen::Vector3d(corner + aside).data()));
    }
    addPoint((corners[0] + corners[1] + corners[2]) / 3.0 + aside, points, dots);
  }
}

} // namespace

FaultMarks::FaultMarks(vtkRenderer& renderer)
  : renderer_(renderer)
{
  for (std::size_t i = 0; i < layers_.size(); ++i)
  {
    auto& [marks, actor] = layers_.at(i);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(marks);
    appearance::drawInFront(*mapper);
    mapper->SetRelativeCoincidentTopologyPointOffsetParameter(kStyles.at(i).forward);
    actor->SetMapper(mapper);
    actor->PickableOff();
    actor->UseBoundsOff(); // the view is fitted to the body
    actor->VisibilityOff();
    actor->GetProperty()->LightingOff(); // the color of the legend also in the shade
    actor->GetProperty()->RenderPointsAsSpheresOn();
    appearance::setColor(*actor->GetProperty(), kStyles.at(i).color);
    renderer.AddActor(actor);
  }
}

void FaultMarks::show(
  std::span<const Corners> triangles, std::span<const Eigen::Vector3d> places, double lift)
{
  std::array<vtkNew<vtkPoints>, 2> points;
  std::array<vtkNew<vtkCellArray>, 2> dots;
  vtkNew<vtkCellArray> faces;
  for (const Corners& corners : triangles)
  {
    addTriangle(corners, lift, *points[0], *faces, *dots[0]);
  }
  for (const Eigen::Vector3d& place : places)
  {
    addPoint(place, *points[1], *dots[1]);
  }
  const double scale = renderer_.GetRenderWindow()->GetDPI() / double{ appearance::kDpi };
  for (std::size_t i = 0; i < layers_.size(); ++i)
  {
    auto& [marks, actor] = layers_.at(i);
    const std::size_t of = std::min<std::size_t>(i, 1);
    marks->SetPoints(points.at(of));
    marks->SetVerts(dots.at(of));
    i == 0 ? marks->SetPolys(faces) : void();
    marks->Modified();
    actor->GetProperty()->SetPointSize(static_cast<float>(scale) * kStyles.at(i).size);
    actor->SetVisibility(points.at(of)->GetNumberOfPoints() > 0);
  }
}

} // namespace palp
