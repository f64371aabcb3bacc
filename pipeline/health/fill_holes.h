#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <array>
#include <cstddef>
#include <set>
#include <span>
#include <vector>

namespace palp
{

/// Length around a closed chain of points [m].
[[nodiscard]] double lengthAround(
  std::span<const Eigen::Vector3d> points, std::span<const int> chain);

/// Closes a chain of points by triangles of the least area in all.
///
/// O(n^3); no point is added.
///
/// @param chain   3 points or more, in the order in which the triangles are to go around them
/// @param known   edges that it may not have, the lower point first, but for those of the chain
/// @return        none where it cannot be without those
/// @source        Barequet and Sharir, Computer Aided Geometric Design 12(2), 1995
[[nodiscard]] std::vector<Triangle> smallestFilling(std::span<const Eigen::Vector3d> points,
  std::span<const int> chain, const std::set<std::array<int, 2>>& known = {});

/// Holes within the limit.
struct FilledHoles
{
  std::size_t closed = 0;
  std::size_t crossing = 0; ///< left, as what would close them passes through the surface
  std::size_t unfit = 0;    ///< left: too many edges, or no triangles but such as the surface has
};

/// Closes the holes that are not longer around than a limit, and have at most 500 edges.
///
/// @param triangles  turned alike; those that close holes are added
/// @param longest    [m]
FilledHoles fillHoles(
  std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles, double longest);

} // namespace palp
