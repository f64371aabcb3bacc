#pragma once

#include "haptics/surface/surface.h"

#include <span>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// A surface made ready for pressing, and what had to be done to it.
struct RepairedSurface
{
  vtkSmartPointer<vtkPolyData> mesh; ///< triangles only, in the unit of the input
  bool closed = false;               ///< every edge has exactly two triangles
  std::vector<std::string> notes;    ///< what was changed, in words
  std::vector<std::string> warnings; ///< what could not be, in words
};

/// Triangles with shared corners, oriented alike, outwards where the surface is closed.
///
/// Coincident points are merged, triangles that have fewer than three corners then dropped,
/// points that no triangle uses as well.
///
/// @param points     finite
/// @param triangles  indices in range
/// @param name       stands before the message
/// @param isLevel    whether it is where an image has one value, so that bodies face outward and
///                   hollows inward already
/// @throws Error     BadMesh: no triangle with an area remains
[[nodiscard]] RepairedSurface repair(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const std::string& name, bool isLevel = false);

} // namespace palp
