#pragma once

#include "haptics/surface/box_tree.h"

#include <Eigen/Core>
#include <limits>

namespace palp
{

/// Where a ray meets a surface.
struct RayHit
{
  int triangle = -1;                                         ///< -1: nowhere
  double distance = std::numeric_limits<double>::infinity(); ///< along the ray [m], more than 0
};

/// The first triangle that a ray enters the body through. Triangles reach a little beyond their
/// edges, so that no ray slips between two.
///
/// @param tree       of the surface
/// @param origin     [m]
/// @param direction  unit vector
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] RayHit rayEntry(
  const BoxTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) noexcept;

/// The first triangle that a ray leaves the body through, likewise.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] RayHit rayExit(
  const BoxTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) noexcept;

} // namespace palp
