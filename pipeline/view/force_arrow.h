#pragma once

#include "pipeline/view/before_render.h"
#include "pipeline/view/overlay_props.h"

#include <Eigen/Core>

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkNew.h>
#include <vtkTextActor.h>

namespace palp
{

/// The force on the hand as an arrow, as long as it is large, up to a fraction of the body, with
/// its value in newtons.
class ForceArrow : public OverlayProps
{
public:
  explicit ForceArrow(vtkRenderer& renderer);

  /// @param force     [N]
  /// @param diagonal  of the body's bounding box [m]
  /// @return          [m]
  [[nodiscard]] static double lengthOf(double force, double diagonal) noexcept;

  void show(const OverlayState& state) override;
  void hide() override;

private:
  vtkNew<vtkArrowSource> source_;
  vtkNew<vtkActor> arrow_;
  vtkNew<vtkTextActor> label_;
  Eigen::Vector3d end_ = Eigen::Vector3d::Zero(); // of the arrow [m]
  BeforeRender layOut_;                           // the label, within the picture
};

} // namespace palp
