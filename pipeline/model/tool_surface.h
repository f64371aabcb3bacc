#pragma once

#include "haptics/tip/tip.h"

#include <Eigen/Core>
#include <span>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// The tool for drawing: its apex at the origin, its handle along +z [m].
///
/// @param tip     checked
/// @param length  of the shaft above the base [m]
[[nodiscard]] vtkSmartPointer<vtkPolyData> toolSurface(const Tip& tip, double length);

/// A surface of revolution about z, closed and outward, with creases at its edges.
///
/// @param profile  distance from z and height, from below; begins and ends on z
/// @param sides    of what is drawn instead of a circle
[[nodiscard]] vtkSmartPointer<vtkPolyData> revolved(
  std::span<const Eigen::Vector2d> profile, int sides = 64);

} // namespace palp
