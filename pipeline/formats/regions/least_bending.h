#pragma once

#include "haptics/surface/edges.h"

#include <Eigen/Core>
#include <span>
#include <vector>

namespace palp
{

/// One of the pieces of a closed surface.
struct PieceSize
{
  double volume = 0.0; ///< negative where it faces inward [unit^3]
  double area = 0.0;   ///< [unit^2]
};

/// @param pieces  of each triangle, as piecesOf
[[nodiscard]] std::vector<PieceSize> pieceSizes(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> pieces);

/// Moves the points of a closed surface to that which bends least among those near it.
///
/// The sum of the squared Laplacians is made small by projected gradients; terraces as wide as ten
/// edges vanish.
///
/// @param edges   of the triangles
/// @param most    how far a point may move along each axis [unit of the points]
/// @param pieces  of each triangle, as piecesOf
/// @param sizes   what volume each is to have then, by as little as there is room for [unit^3]
/// @source        Beck and Teboulle, SIAM J. Imaging Sci. 2(1), 2009
void bendLeast(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles,
  const Edges& edges, const Eigen::Array3d& most, std::span<const int> pieces,
  std::span<const PieceSize> sizes);

} // namespace palp
