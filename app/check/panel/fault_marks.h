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

/// Marks on a body where its surface is not as it should be: triangles, each with a dot by which
/// the smallest is seen from afar, and places with a larger one.
class FaultMarks
{
public:
  /// Unlike tissue, maps and all that is drawn of a press.
  static constexpr appearance::Color kColor{ 1.0, 0.25, 0.95 };

  using Corners = std::array<Eigen::Vector3d, 3>;

  /// None are shown at first.
  /// @param renderer  outlives this object
  explicit FaultMarks(vtkRenderer& renderer);

  /// These, and no others.
  /// @param triangles  corners [m], facing any way
  /// @param places     [m]
  /// @param lift       in front of the body, which may be shown coarser [m]
  void show(
    std::span<const Corners> triangles, std::span<const Eigen::Vector3d> places, double lift);

private:
  struct Layer
  {
    vtkNew<vtkPolyData> marks;
    vtkNew<vtkActor> actor;
  };
  vtkRenderer& renderer_;
  std::array<Layer, 2> layers_; // triangles with their dots; places
};

} // namespace palp
