#pragma once

#include "pipeline/layout/before_render.h"
#include "pipeline/view/overlay_props.h"

#include <Eigen/Core>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkTextActor.h>

namespace palp
{

/// The force on the hand as an arrow beside the tool, with its value in newtons at a leader line.
///
/// Its shaft is as long as the force is large, a ruler with a ring each so many newtons; a force
/// too large for the body's size is drawn to a smaller scale.
class ForceArrow : public OverlayProps
{
public:
  explicit ForceArrow(vtkRenderer& renderer);

  /// What lengths mean.
  struct Scale
  {
    double length; ///< of the shaft for each newton [m/N]
    double ring;   ///< force from ring to ring [N]
  };

  /// @param force     [N]
  /// @param diagonal  of the body's bounding box [m]
  [[nodiscard]] static Scale scaleOf(double force, double diagonal) noexcept;

  /// Of the whole arrow: the shaft, and a head that is always the same.
  /// @return  [m]
  [[nodiscard]] static double lengthOf(double force, double diagonal) noexcept;

  void show(const OverlayState& state) override;
  void hide() override;

private:
  void place(vtkRenderer& renderer, const PictureRoom& room);

  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> arrow_;
  vtkNew<vtkTextActor> label_;
  vtkNew<vtkPolyData> line_; // to the label [pixels]
  vtkNew<vtkActor2D> leader_;
  Eigen::Vector3d start_ = Eigen::Vector3d::Zero(); // on the tool's axis [m]
  Eigen::Vector3d along_ = Eigen::Vector3d::UnitZ();
  double length_ = 0.0; // [m]
  double aside_ = 0.0;  // from the axis [m]
  BeforeRender layOut_; // beside the tool as it is seen, the label within the picture
};

} // namespace palp
