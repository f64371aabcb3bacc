#pragma once

#include "pipeline/view/overlay_props.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace palp
{

/// The control points of the ring's Bezier patches and the lines between them, as in Fig. 5(a).
class ControlNet : public OverlayProps
{
public:
  explicit ControlNet(vtkRenderer& renderer);
  void show(const OverlayState& state) override;
  void hide() override;

private:
  vtkNew<vtkPolyData> net_;
  vtkNew<vtkActor> actor_;
};

/// Points P_ij of a dent, i = 0..2 outwards varying fastest, with lines and vertices.
void fillControlNet(const Dent& dent, vtkPolyData& net);

} // namespace palp
