#pragma once

#include "haptics/surface/box_tree.h"

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// A place where triangles that share no edge there pass through each other; none: the surface
/// crosses itself nowhere. What only touches does not cross.
///
/// @param triangles  that the tree was built of
[[nodiscard]] std::optional<Eigen::Vector3d> findCrossing(
  const BoxTree& tree, std::span<const Triangle> triangles);

/// The triangles that pass through others, or that others pass through, each once and in order.
///
/// @param triangles  that the tree was built of
[[nodiscard]] std::vector<int> crossingTriangles(
  const BoxTree& tree, std::span<const Triangle> triangles);

} // namespace palp
