#pragma once

#include "haptics/contact/overlap/immersion.h"

namespace palp
{

/// How deep a punch is in a smooth body that has as much lift in common with it: the volume, by how
/// far it is over the flat, or half of the squared depth over the flat.
///
/// That is what springs below each part of the flat would store, so that faces of other heights
/// come in from nothing on, however the flat meets them. On a plane that leans, the depth is the
/// root of the mean square, whose slope makes the force that of the mean depth.
///
/// @param radius     of the flat [m]
/// @param lift       above 0 [m^4]
/// @param curvature  of the body, mean, convex positive [1/m]
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] Immersion flatImmersionOf(double radius, double lift, double curvature) noexcept;

} // namespace palp
