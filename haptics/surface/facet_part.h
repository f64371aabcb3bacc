#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// A triangle, or a part of it.
struct FacetPart
{
  std::array<Eigen::Vector3d, 3> corners; ///< [m]
  std::array<int, 3> sides;               ///< of the triangle, from corner k to k + 1; -1 within it
};

/// Halves the longest side until none is longer than a cell [m]; use(part) for each.
template <typename Use>
void cut(const FacetPart& piece, double cell, Use use)
{
  const auto& p = piece.corners;
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
  {
    k = (p[(i + 1) % 3] - p[i]).squaredNorm() > (p[(k + 1) % 3] - p[k]).squaredNorm() ? i : k;
  }
  const std::size_t next = (k + 1) % 3;
  const std::size_t last = (k + 2) % 3;
  if (!((p[next] - p[k]).squaredNorm() > cell * cell))
  {
    use(piece);
    return;
  }
  const Eigen::Vector3d middle = 0.5 * (p[k] + p[next]);
  cut(FacetPart{ { p[k], middle, p[last] }, { piece.sides[k], -1, piece.sides[last] } }, cell, use);
  cut(FacetPart{ { middle, p[next], p[last] }, { piece.sides[k], piece.sides[next], -1 } }, cell,
    use);
}

/// Triangles with what lies across their sides.
struct LinkedTriangles
{
  std::span<const Eigen::Vector3d> points; ///< [m]
  std::span<const Triangle> triangles;
  std::span<const std::array<int, 3>> across; ///< triangles, from corner k to k + 1; -1: none
};

/// Which sides of triangles stand for what is round, and which are edges of the body itself: those
/// that turn outward by more than 45 degrees, and those, valleys too, that turn by more than 17
/// between faces flat on both sides.
struct Creases
{
  std::vector<std::array<bool, 3>>
    sides;                  ///< of each triangle, from corner k to k + 1: such an edge
  double facetLength = 0.0; ///< root mean square side of triangles at one that is none [m]
};

/// O(n). @param mesh  closed or open; what lies about an open edge is none
[[nodiscard]] Creases creasesOf(const LinkedTriangles& mesh);

/// By half of what the surface turns at each side of a triangle, across that side, per length.
///
/// @return  one symmetric tensor a side [rad], zero at an open one
[[nodiscard]] std::array<Eigen::Matrix3d, 3> bendsOf(const LinkedTriangles& mesh, int triangle);

/// What a triangle adds to the curvature of a surface.
struct FacetBend
{
  std::array<float, 3> turns{};          ///< of the surface at its sides, half of it each [rad]
  std::optional<Eigen::Matrix3f> even{}; ///< length of its sides times their bends, evened out [m]
};

/// What the sides of each triangle turn, and the same evened out over those about its points: one
/// alone turns in some of the surface's directions only. The sum over all stays.
///
/// @param longest  triangles with a longer side, or beside a crease, are not evened out [m]
/// @return         by the tree's facets
[[nodiscard]] std::vector<FacetBend> evenBends(
  const BoxTree& tree, const LinkedTriangles& mesh, const Creases& creases, double longest);

/// How large a hollow each triangle bounds: the radius of a ball with as much surface as the closed
/// piece that it belongs to, where that faces its own inside; else 0 [m].
[[nodiscard]] std::vector<float> hollowRadii(const LinkedTriangles& mesh);

} // namespace palp
