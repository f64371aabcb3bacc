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

/// Collapses the short edge of slivers that have one, and flips the longest edge of the others,
/// where both triangles become higher and no other normal turns by more than 25 degrees.
///
/// @param points     [m]
/// @param triangles  a manifold, but for what cannot be one, which is left alone
/// @return           triangles that are no slivers any more
std::size_t removeSlivers(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles);

} // namespace palp
