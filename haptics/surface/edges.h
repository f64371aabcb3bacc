#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// How the triangles of a surface meet; those without three different corners count for nothing.
struct Edges
{
  /// The triangle behind each side, which goes from corner k to k + 1; -1: none, or several.
  std::vector<std::array<int, 3>> across;
  std::vector<std::array<int, 2>> all{};      ///< points of each edge, the lower first, in order
  std::vector<std::array<int, 2>> unpaired{}; ///< those with one triangle, or with more than two
  std::size_t crowded = 0;                    ///< those with more than two
  std::size_t unbalanced = 0; ///< those that are not gone along as often one way as the other
};

/// O(n log n) for any triangles.
/// @param triangles  indices below points
[[nodiscard]] Edges edgesOf(std::size_t points, std::span<const Triangle> triangles);

/// Which piece each triangle belongs to, from 0 on in the order of their first triangles; what is
/// across a side is of the same piece.
[[nodiscard]] std::vector<int> piecesOf(std::span<const std::array<int, 3>> across);

} // namespace palp
