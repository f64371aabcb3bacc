#pragma once

#include "pipeline/view/appearance.h"

#include <Eigen/Core>
#include <array>
#include <span>
#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

class vtkRenderer;

namespace palp
{

/// Paint on a body: triangles of its surface, each of a color, a little above it, for what is shown
/// may be finer than what was painted.
class PaintedPatches
{
public:
  /// None are shown at first.
  /// @param renderer  outlives this object
  explicit PaintedPatches(vtkRenderer& renderer);

  struct Patch
  {
    std::array<Eigen::Vector3d, 3> corners; ///< [m], counterclockwise from outside
    appearance::Color color;
  };

  /// These, and no others.
  void show(std::span<const Patch> patches);

private:
  vtkNew<vtkPolyData> surface_;
  vtkNew<vtkActor> actor_;
};

} // namespace palp
