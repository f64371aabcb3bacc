#pragma once

#include "haptics/surface/tree/box_tree.h"
#include "haptics/surface/winding.h"

#include <Eigen/Core>
#include <array>
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

/// The triangles near another piece that have the body, or nothing, on both sides: where pieces
/// touch, or overlap and their walls meet in edges or planes, none passes through another.
///
/// @param tree    of all triangles of a closed surface
/// @param pieces  of each triangle, by piecesOf
[[nodiscard]] std::vector<int> buriedTriangles(const BoxTree& tree, std::span<const int> pieces);

/// How far beside a triangle its two sides are looked at [m].
[[nodiscard]] double asideOf(const BoxTree& tree) noexcept;

/// Whether the body, or nothing, is on both sides of a triangle: it bounds nothing.
/// @param aside  by asideOf
[[nodiscard]] bool isBuried(const Winding& winding, const Facet& facet, double aside) noexcept;

/// The pairs of triangles that pass through each other, the lower index first, each once and in
/// order.
///
/// @param triangles  that the tree was built of
[[nodiscard]] std::vector<std::array<int, 2>> crossingPairs(
  const BoxTree& tree, std::span<const Triangle> triangles);

/// The triangles of these pairs, each once and in order.
[[nodiscard]] std::vector<int> crossingTriangles(
  const BoxTree& tree, std::span<const Triangle> triangles);

} // namespace palp
