#pragma once

#include "haptics/surface/box_tree.h"

#include <cstddef>
#include <vector>

namespace palp
{

/// A triangle is a sliver where its height over its longest edge is less than this share of it.
constexpr double kSliver = 0.01;

/// Height of a triangle over its longest edge, as a share of that edge [-].
[[nodiscard]] double flatness(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) noexcept;

/// Triangles that are no slivers any more, and those that are left since the surface would pass
/// through itself without them.
struct RemovedSlivers
{
  std::size_t removed = 0;
  std::size_t left = 0;
};

/// Collapses the short edge of slivers that have one, and flips the longest edge of the others,
/// where both triangles become higher, no other normal turns by more than 25 degrees and nothing
/// passes through the surface that did not before.
///
/// @param points     [m]
/// @param triangles  a manifold, but for what cannot be one, which is left alone
RemovedSlivers removeSlivers(
  std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

} // namespace palp
