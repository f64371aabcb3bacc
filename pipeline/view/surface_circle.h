#pragma once

#include "pipeline/view/overlay_props.h"

#include <array>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{

/// A circle around the contact, drawn on the surface where it is pressed: the contact or R_d.
class SurfaceCircle : public OverlayProps
{
public:
  enum class Of
  {
    Contact,
    Extent
  };

  SurfaceCircle(vtkRenderer& renderer, Of of);
  void show(const OverlayState& state) override;
  void hide() override;

private:
  void putOnField(const Dent& dent, double radius);

  Of of_;
  vtkNew<vtkPolyData> line_;
  vtkNew<vtkActor> actor_;
};

} // namespace palp
