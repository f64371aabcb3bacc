#pragma once

#include "haptics/contact/overlap/immersion.h"

namespace palp
{

/// How deep a tool with a flat at its apex is in a smooth body that has as much lift in common with
/// it: the volume, by how far it is over the flat; below a punch, half of the squared depth over
/// it.
///
/// That is what springs below each part of the flat would store, so that faces of other heights
/// come in from nothing on, however the flat meets them. However it leans, it is as deep as its
/// middle would be were it level: there the root of the mean square, whose slope makes the force
/// on a punch that of its mean depth.
///
/// @param solid      with a flat
/// @param lift       above 0 [m^4]
/// @param curvature  of the body, mean, convex positive [1/m]; a hollow is leveled off where it is
///                   rounder than what of the tool is in it
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] Immersion flatImmersionOf(
  const ToolSolid& solid, double lift, double curvature) noexcept;

} // namespace palp
