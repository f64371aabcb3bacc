#pragma once

#include "pipeline/formats/regions/least_bending.h"

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// Of a closed contour, what is taken: its largest pieces, and the walls of their hollows.
struct ContourPieces
{
  std::vector<bool> isKept; ///< each triangle
  bool areAll = true;       ///< it is
  std::string note;         ///< what was left out, for people; empty: it is one piece
};

/// @param pieces       of each triangle, as piecesOf
/// @param sizes        of each piece
/// @param components   how many, the largest first
/// @param leastHollow  volume below which a hollow is filled [unit^3]
[[nodiscard]] ContourPieces contourPieces(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> pieces,
  std::span<const PieceSize> sizes, std::size_t components, double leastHollow);

} // namespace palp
