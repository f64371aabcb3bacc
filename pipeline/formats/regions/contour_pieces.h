#pragma once

#include "pipeline/formats/regions/piece_volumes.h"
#include "pipeline/process/file_organs.h"

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace palp
{

inline constexpr double kLeastHollow = 100.0; ///< [voxels]; what is smaller is filled

/// Of a closed contour, what is taken: its largest pieces, and the walls of their hollows.
struct ContourPieces
{
  std::vector<bool> isKept; ///< each triangle
  bool areAll = true;       ///< it is
  std::string note;         ///< what was left out, for people; empty: it is one piece
};

/// Volume below which a piece has fewer voxels than a body, to their rounding [unit^3].
/// @param voxel  volume of one [unit^3]
[[nodiscard]] constexpr double leastPiece(double voxel) noexcept
{
  return (kFewestVoxels - 0.5) * voxel;
}

/// The largest piece, however small, and those besides that have as many voxels as a body; hollows
/// of less than 100 voxels are filled.
///
/// @param pieces      of each triangle, as piecesOf
/// @param sizes       of each piece
/// @param components  how many, the largest first
/// @param voxel       volume of one [unit^3]
[[nodiscard]] ContourPieces contourPieces(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> pieces,
  std::span<const PieceSize> sizes, std::size_t components, double voxel);

} // namespace palp
