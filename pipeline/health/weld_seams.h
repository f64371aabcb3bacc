#pragma once

#include "haptics/surface/box_tree.h"

#include <span>
#include <vector>

namespace palp
{

/// Moves points at open edges onto others there that are next to them, as along the seams of parts
/// that were written by themselves: within a thousandth of the shortest open edge at both, or a
/// hundredth where that does not sew them. A seam that would stay open in places is left alone.
///
/// O(n log n) for seams that run along any lines.
///
/// @param points     finite, each once [m]
/// @param triangles  indices in range
/// @return           whether any moved, to where another is
[[nodiscard]] bool weldSeams(
  std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles);

} // namespace palp
