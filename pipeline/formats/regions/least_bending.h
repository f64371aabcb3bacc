#pragma once

#include "haptics/surface/edges.h"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace palp
{

/// Moves the points of a closed surface to that which bends least among those near it.
///
/// The sum of the squared Laplacians is made small by projected gradients; terraces as wide as ten
/// edges vanish.
///
/// @param edges   of the triangles
/// @param most    how far a point may move along each axis [unit of the points]
/// @param volume  that the surface is to have then, by as little as there is room for [unit^3]
/// @source        Beck and Teboulle, SIAM J. Imaging Sci. 2(1), 2009
void bendLeast(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles,
  const Edges& edges, const Eigen::Array3d& most, double volume);

} // namespace palp
