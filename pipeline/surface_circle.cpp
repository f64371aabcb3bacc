#include "pipeline/surface_circle.h"

#include "pipeline/appearance.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{

SurfaceCircle::SurfaceCircle(vtkRenderer& renderer, vtkPalpDeformFilter& press, Of of)
  : of_(of)
{
  contour_->SetInputConnection(press.GetOutputPort(1));
  contour_->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Distance");
  contour_->ComputeScalarsOff();
  contour_->ComputeNormalsOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(contour_->GetOutputPort());
  mapper->ScalarVisibilityOff();
  appearance::drawInFront(*mapper);
  actor_->SetMapper(mapper);
  appearance::setColor(
    *actor_->GetProperty(), of == Of::Contact ? appearance::kContact : appearance::kExtent);
  actor_->GetProperty()->SetLineWidth(3.0F);
  actor_->GetProperty()->LightingOff();
  renderer.AddActor(actor_);
  SurfaceCircle::hide();
}

void SurfaceCircle::show(const Moment& moment)
{
  const double radius =
    of_ == Of::Contact ? moment.sample.response.contactRadius : moment.extentRadius;
  contour_->SetValue(0, radius);
  actor_->SetVisibility(radius > 0.0);
}

void SurfaceCircle::hide()
{
  actor_->VisibilityOff();
}

} // namespace palp
