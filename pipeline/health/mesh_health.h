#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace palp
{

/// What a surface can have that a press, or another program, takes ill.
enum class Fault
{
  DuplicatePoint,    ///< at the place of another, where triangles share any
  UnusedPoint,       ///< of no triangle
  Degenerate,        ///< a triangle without an area
  DuplicateTriangle, ///< between the points of another
  Sliver,            ///< a triangle a hundred times as long as high, or more
  Flipped,           ///< a triangle that faces the body, or against its neighbors
  NonManifoldEdge,   ///< of three triangles or more
  NonManifoldPoint,  ///< where parts of the surface meet that no edge joins
  Hole,              ///< a closed chain of edges with one triangle each
  SelfIntersection, ///< a triangle that passes through another, or lies in or against another piece
  InnerPiece,       ///< a closed piece within another one that faces alike
};

/// @return  in words, as "non-manifold edge"
[[nodiscard]] std::string_view nameOf(Fault fault) noexcept;

/// One kind of fault in a surface.
struct Finding
{
  Fault fault;
  std::size_t count = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< of the first; of the widest hole [m]
  double size = 0.0;                               ///< of that hole: length around it [m]
  std::vector<int> triangles{};                    ///< that have it
};

/// Triangles that hang together.
struct MeshPiece
{
  std::size_t triangles = 0;
  bool closed = true;
  double volume = 0.0; ///< [m^3], negative where it faces inward; without meaning where open
};

/// What is known of a surface before it is pressed.
struct MeshHealth
{
  std::size_t points = 0; ///< different ones where each triangle has its own, as STL has it
  std::size_t triangles = 0;
  std::vector<Finding> findings{};   ///< in the order of Fault; only those that were found
  std::vector<MeshPiece> pieces{};   ///< the largest first
  std::vector<double> edgeLengths{}; ///< of all edges, the shortest first [m]
  Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< corner of the box around it [m]
  Eigen::Vector3d high = Eigen::Vector3d::Zero(); ///< and the other [m]

  /// @return  null where there is none
  [[nodiscard]] const Finding* find(Fault fault) const noexcept;
};

/// O(n log n) for any triangles.
///
/// @param points     finite [m]
/// @param triangles  indices in range, at least one
/// @throws Error     NoSolution: it is not wanted any longer, see checkWanted()
[[nodiscard]] MeshHealth healthOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);

} // namespace palp
