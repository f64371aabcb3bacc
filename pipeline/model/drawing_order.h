#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// The triangles of a mesh, each beside some of its neighbors, so that a renderer finds most
/// corners of a triangle among those that it has just shaded.
///
/// @param triangles   indices of points
/// @param pointCount  above every index
/// @return            the same triangles, corners in the same order
/// @source            Sander, Nehab, Barczak, "Fast triangle reordering for vertex locality and
///                    reduced overdraw", ACM TOG 26(3), 2007: time is linear
[[nodiscard]] std::vector<Triangle> inDrawingOrder(
  std::span<const Triangle> triangles, std::size_t pointCount);

} // namespace palp
