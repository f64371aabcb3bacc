#pragma once

#include "pipeline/view/overlay_props.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkWarpVector.h>

namespace palp
{

/// The surface where it was before the press, translucent over the dent.
class Ghost : public OverlayProps
{
public:
  Ghost(vtkRenderer& renderer, vtkPalpDeformFilter& press);
  void show(const OverlayState& state) override;
  void hide() override;

private:
  vtkNew<vtkWarpVector> warp_;
  vtkNew<vtkActor> actor_;
};

} // namespace palp
