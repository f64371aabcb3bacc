#pragma once

#include "haptics/surface/edges.h"

#include <array>
#include <span>
#include <vector>

namespace palp
{

/// A side of a triangle, from corner k to k + 1.
struct Side
{
  int triangle;
  int k;
};

/// The sides at each edge that has not two triangles: one at an open edge, three or more at an
/// edge that is not manifold.
/// @param edges  of the triangles
[[nodiscard]] std::vector<std::vector<Side>> unpairedSides(
  std::span<const Triangle> triangles, const Edges& edges);

/// The chains of sides at open edges, each closed around a hole. Holes that meet at a point, or
/// around a triangle that hangs by its corners, are as many as one sees.
/// @param triangles  turned alike; where they cannot be, chains are not closed
[[nodiscard]] std::vector<std::vector<Side>> borders(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, const Edges& edges);

/// A number for each corner, the same for those of a point whose triangles hang together across
/// edges that they share; a point with several is not manifold.
[[nodiscard]] std::vector<std::array<int, 3>> fansOf(
  std::span<const Triangle> triangles, const Edges& edges);

} // namespace palp
