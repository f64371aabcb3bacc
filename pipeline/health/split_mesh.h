#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <vector>

namespace palp
{

/// Points that were added, and those that are left as they were, since the surface would pass
/// through itself near them however they were parted.
struct SplitPoints
{
  std::size_t added = 0;
  std::size_t left = 0;
};

/// Parts triangles that meet in edges of more than two, or in points only: at an edge those that
/// bound the same wedge of the body stay together, what is odd there becomes open, and what still
/// meets around both ends of an edge is torn off.
///
/// @param points     [m]; new ones are added, and what was parted from the larger moves off by a
///                   thousandth of the edges around, where nothing passes through the surface by
///                   that
/// @param triangles  facing outward
SplitPoints splitNonManifold(
  std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

} // namespace palp
