#include "app/check/panel/fault_marks.h"

#include <Eigen/Geometry>
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

constexpr std::array kDots{ 7.0F, 16.0F }; // of each layer [pixels]

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
  for (auto& [marks, actor] : layers_)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(marks);
    appearance::drawInFront(*mapper);
    actor->SetMapper(mapper);
    actor->PickableOff();
    actor->UseBoundsOff(); // the view is fitted to the body
    actor->VisibilityOff();
    actor->GetProperty()->LightingOff();             // the color of the legend also in the shade
    actor->GetProperty()->RenderPointsAsSpheresOn(); // which stand out of the surface
    appearance::setColor(*actor->GetProperty(), kColor);
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
  layers_[0].marks->SetPolys(faces);
  const double scale = renderer_.GetRenderWindow()->GetDPI() / appearance::kDpi;
  for (std::size_t i = 0; i < layers_.size(); ++i)
  {
    auto& [marks, actor] = layers_.at(i);
    marks->SetPoints(points.at(i));
    marks->SetVerts(dots.at(i));
    marks->Modified();
    actor->GetProperty()->SetPointSize(static_cast<float>(scale) * kDots.at(i));
    actor->SetVisibility(points.at(i)->GetNumberOfPoints() > 0);
  }
}

} // namespace palp
