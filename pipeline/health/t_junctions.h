#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// Puts points at open edges into other open edges on which they lie, to a thousandth of the edge:
/// where one triangle has two behind one side of its, it is cut, so that nothing is open there.
/// Where a part of an edge would stay open, it is left alone.
///
/// O(n log n) for edges that are short beside the surface.
///
/// @param points     finite, each once [m]
/// @param triangles  indices in range, with three different corners
/// @return           how many triangles there are more
[[nodiscard]] std::size_t cutAtTJunctions(
  std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles);

} // namespace palp
