#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <limits>
#include <span>

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

/// What lies below a place of a surface.
struct Below
{
  double thickness = 0.0; ///< to the far side of the body, hollows filled [m]
  bool isHollow = false;  ///< a hollow is so near, or the far side so free, that the wall bends
};

/// @param tree     of the surface
/// @param hollows  of each triangle, by hollowRadii
/// @param from     on the surface [m]
/// @param inward   unit vector
[[nodiscard]] Below lookBelow(const BoxTree& tree, std::span<const float> hollows,
  const Eigen::Vector3d& from, const Eigen::Vector3d& inward) noexcept;

} // namespace palp
