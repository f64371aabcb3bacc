#pragma once

#include "pipeline/formats/regions/neighbors.h"

#include <Eigen/Core>
#include <functional>
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

/// Gives a surface the volume back that smoothing took from it: first where it was taken, within
/// some ten edges, and then what each piece still lacks, evenly.
///
/// @param from    where its points were before
/// @param bound   takes points back to where they may be
/// @param pieces  of each triangle, as piecesOf
/// @param sizes   what volume each is to have then, by as little as there is room for [unit^3]
/// @source        what is taken: the volumes that triangles sweep; its spread: the Chebyshev
///                semi-iteration (Golub and Varga, Numerische Mathematik 3, 1961) of a random walk
void restoreVolumes(std::vector<Eigen::Vector3d>& points, std::span<const Eigen::Vector3d> from,
  std::span<const Triangle> triangles, const Neighbors& neighbors,
  const std::function<void()>& bound, std::span<const int> pieces,
  std::span<const PieceSize> sizes);

} // namespace palp
