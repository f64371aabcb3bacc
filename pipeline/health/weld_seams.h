#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// What came of seams.
struct WeldedSeams
{
  bool isSewn = false;
  std::size_t left = 0; ///< open edges beside others, within a tenth of their length, if not
};

/// Moves points at open edges onto others that are next to them, as along the seams of parts that
/// were written by themselves, some of which may be closed: within 1/50 of the shortest open edge
/// at both, or of the shortest of a point that is at none, and twice as far no other. A seam that
/// would stay open in places is left alone.
///
/// O(n log n) for seams that run along any lines.
///
/// @param points     finite, each once [m]
/// @param triangles  indices in range
[[nodiscard]] WeldedSeams weldSeams(
  std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles);

} // namespace palp
