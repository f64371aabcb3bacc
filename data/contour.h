#pragma once

#include "data/implicit.h"
#include "data/shapes.h"

namespace palp
{

/// Closed, even surface of a body in a box.
///
/// @param low, high  corners of the box, outside the body [m]
/// @param spacing    of the samples, finer than the body's details [m]
/// @param edge       wanted edge length [m]
[[nodiscard]] Mesh contoured(const Distance& distance, const Eigen::Vector3d& low,
  const Eigen::Vector3d& high, double spacing, double edge);

} // namespace palp
