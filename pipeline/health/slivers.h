#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <vector>

namespace palp
{

/// A triangle is a sliver where it is flatter (area_and_volume.h) than this.
constexpr double kSliver = 0.01;

/// Triangles that are no slivers any more, and those that are left since the surface would pass
/// through itself without them.
struct RemovedSlivers
{
  std::size_t removed = 0;
  std::size_t left = 0;
};

/// Collapses the short edge of slivers that have one, and flips the longest edge of the others,
/// where both triangles become higher, no other normal turns by more than 25 degrees and nothing
/// passes through the surface that did not before.
///
/// @param points     [m]
/// @param triangles  a manifold, but for what cannot be one, which is left alone
RemovedSlivers removeSlivers(
  std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

} // namespace palp
