#include "pipeline/view/ghost.h"

#include "pipeline/view/appearance.h"

#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace palp
{

Ghost::Ghost(vtkRenderer& renderer, vtkPalpDeformFilter& press)
{
  warp_->SetInputConnection(press.GetOutputPort(1));
  warp_->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Displacement");
  warp_->SetScaleFactor(-1.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(warp_->GetOutputPort());
  mapper->ScalarVisibilityOff();
  appearance::drawInFront(*mapper);
  actor_->SetMapper(mapper);
  appearance::setColor(*actor_->GetProperty(), appearance::kGhost);
  actor_->GetProperty()->SetOpacity(0.35);
  actor_->GetProperty()->LightingOff(); // its normals are those of the dent
  renderer.AddActor(actor_);
  Ghost::hide();
}

void Ghost::show(const OverlayState&)
{
  actor_->VisibilityOn();
}

void Ghost::hide()
{
  actor_->VisibilityOff();
}

} // namespace palp
