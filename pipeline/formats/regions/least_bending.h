#pragma once

#include "pipeline/formats/regions/neighbors.h"

#include <Eigen/Core>
#include <vector>

namespace palp
{

/// Moves the points of a closed surface to that which bends least among those near it.
///
/// The sum of the squared Laplacians is made small by projected gradients; terraces as wide as ten
/// edges vanish.
///
/// @param most    how far a point may move along each axis [unit of the points]
/// @source        Beck and Teboulle, SIAM J. Imaging Sci. 2(1), 2009
void bendLeast(
  std::vector<Eigen::Vector3d>& points, const Neighbors& neighbors, const Eigen::Array3d& most);

} // namespace palp
