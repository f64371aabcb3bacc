#include "pipeline/figure/painted_patches.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

namespace palp
{
namespace
{

constexpr double kAbove = 0.7e-3; // [m]; as far as the bundled liver is shown from what is felt
constexpr double kOwnLight = 0.5; // so that its colors are those of the legend also in the shade

} // namespace

PaintedPatches::PaintedPatches(vtkRenderer& renderer)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface_);
  actor_->SetMapper(mapper);
  actor_->PickableOff();
  actor_->UseBoundsOff(); // the view is fitted to the body
  actor_->VisibilityOff();
  actor_->GetProperty()->SetAmbient(kOwnLight);
  actor_->GetProperty()->SetDiffuse(1.0 - kOwnLight);
  actor_->GetProperty()->SetInterpolationToFlat();
  renderer.AddActor(actor_);
}

void PaintedPatches::show(std::span<const Patch> patches)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const auto& [corners, color] : patches)
  {
    const Eigen::Vector3d outward =
      (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    triangles->InsertNextCell(3);
    for (const Eigen::Vector3d& corner : corners)
    {
      const Eigen::Vector3d lifted = corner + kAbove * outward;
      triangles->InsertCellPoint(points->InsertNextPoint(lifted.data()));
    }
    constexpr double kWhole = 255.0;
    for (const double part : color)
    {
      colors->InsertNextValue(static_cast<unsigned char>(std::lround(kWhole * part)));
    }
  }
  surface_->SetPoints(points);
  surface_->SetPolys(triangles);
  surface_->GetCellData()->SetScalars(colors);
  surface_->Modified();
  actor_->SetVisibility(!patches.empty());
}

} // namespace palp
