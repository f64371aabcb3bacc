#pragma once

#include "haptics/surface/surface.h"

#include <cstddef>

namespace palp
{

/// The same shape with fewer points, for the haptic side.
///
/// @param points  at most so many, where the topology allows it; 4 or more
/// @return        closed where the surface is; triangles that turn over are not made
/// @throws Error  BadMesh: an edge with more than two triangles, or triangles of opposite sense
/// @source        Garland and Heckbert, "Surface simplification using quadric error metrics", 1997
[[nodiscard]] Surface decimated(const Surface& surface, std::size_t points);

/// The same of bare triangles, without what a Surface knows besides.
[[nodiscard]] Surface decimated(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, std::size_t count);

} // namespace palp
