#pragma once

#include "pipeline/view/appearance.h"

#include <Eigen/Core>
#include <vtkActor.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace palp
{

/// How far a device reaches: three thin circles about the middle of its workspace.
class ReachOutline
{
public:
  /// None is shown at first.
  /// @param renderer  outlives this object
  explicit ReachOutline(vtkRenderer& renderer)
    : renderer_(renderer)
  {
  }

  /// @param center  [m]
  /// @param radius  [m]; 0: no bound, which shows nothing
  /// @return        whether the picture is another than before
  bool show(const Eigen::Vector3d& center, double radius);

private:
  vtkRenderer& renderer_;
  vtkSmartPointer<vtkActor> actor_{}; // none until one is shown
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.0;
};

} // namespace palp
