#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <optional>

namespace palp
{

/// A place on a surface where a tool can be set.
struct SurfacePoint
{
  Eigen::Vector3d position; ///< on the triangles [m]
  Eigen::Vector3d
    normal; ///< outward unit normal, blended from the corners, but not over edges of the body
};

/// @param position  on the triangle [m]
[[nodiscard]] SurfacePoint surfacePoint(
  const Surface& surface, int triangle, const Eigen::Vector3d& position);

/// The first place where a ray meets the front of a surface.
///
/// @param origin     [m]
/// @param direction  unit vector
/// @return           nothing when the ray misses
[[nodiscard]] std::optional<SurfacePoint> pick(
  const Surface& surface, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

} // namespace palp
