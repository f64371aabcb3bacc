#pragma once

#include "haptics/contact/overlap/immersion.h"

#include <Eigen/Core>

namespace palp
{

/// What a body and a punch have in common.
struct Pressed
{
  double volume; ///< above 0 [m^3]
  double lift; ///< of it, by how far it is over the flat: half of the squared depth over the flat,
               ///< as springs below it would store [m^4]
};

/// How deep a punch is in a smooth body that has as much lift. Depth is that of the middle; where
/// faces of other heights come below the flat they count by what they give way, from nothing on.
///
/// The lift that is due to the lean of the body alone is taken off, by that of a plane of the same
/// volume: the force on a flat that leans is that of its mean depth.
///
/// @param radius     of the flat [m]
/// @param outward    mean normal of the body, of unit length, in the tool's frame
/// @param curvature  mean, convex positive [1/m]
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] Immersion flatImmersionOf(
  double radius, const Eigen::Vector3d& outward, const Pressed& pressed, double curvature) noexcept;

} // namespace palp
