#pragma once

#include "haptics/surface/box_tree.h"

#include <cstddef>
#include <vector>

namespace palp
{

/// Parts triangles that meet in edges of more than two, or in points only: at an edge those that
/// bound the same wedge of the body stay together, what is odd there becomes open, and what still
/// meets around both ends of an edge is torn off.
///
/// @param points     [m]; new ones are added, and what was parted moves off by a thousandth of the
///                   edges around
/// @param triangles  facing outward
/// @return           points that were added
std::size_t splitNonManifold(
  std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

} // namespace palp
