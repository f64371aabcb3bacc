#pragma once

#include "pipeline/view/appearance.h"

#include <Eigen/Core>
#include <vector>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkRenderer;

namespace palp
{

/// Balls beside the body: marks on it, and nodules in it, which a translucent one shows.
class Balls
{
public:
  struct Ball
  {
    Eigen::Vector3d center; ///< [m]
    double radius;          ///< [m]
    appearance::Color color;
  };

  /// None are shown at first.
  /// @param renderer  outlives this object
  explicit Balls(vtkRenderer& renderer)
    : renderer_(renderer)
  {
  }

  /// These, and no others.
  void show(const std::vector<Ball>& balls);

private:
  vtkRenderer& renderer_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

} // namespace palp
