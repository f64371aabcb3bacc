#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// A surface after what is safe was done to it, and what that was.
struct RepairedMesh
{
  std::vector<Eigen::Vector3d> points; ///< [m]
  std::vector<Triangle> triangles;     ///< facing outward where closed
  std::size_t merged = 0;              ///< points at the place of others or of a seam, or not used
  std::size_t removed = 0;     ///< triangles without three corners, there twice, or within the body
  std::size_t slivers = 0;     ///< collapsed, or flipped into others
  std::size_t split = 0;       ///< points made of those where parts met, not as a manifold
  std::size_t cut = 0;         ///< triangles more, where points of others lay on their edges
  std::size_t filled = 0;      ///< holes
  std::size_t turned = 0;      ///< triangles
  std::size_t seamsLeft = 0;   ///< open edges beside others, which cannot be sewn as a whole
  std::size_t splitLeft = 0;   ///< points where parts still meet, which cannot move apart without
                               ///< passing through each other
  std::size_t sliversLeft = 0; ///< without which the surface would pass through itself
  std::size_t holesLeft = 0;   ///< that cannot be closed without passing through it
  std::size_t holesUnfit = 0;  ///< of more than 500 edges, or that no other triangles fit
};

/// Again and again, until nothing is left to do: merges points, welds seams, cuts triangles at
/// points of others on their edges, removes degenerate and duplicate triangles, slivers, walls
/// within a body, and what bodies that touch have between them; once that is done closes small
/// holes, parts what meets in a non-manifold edge or point, and turns triangles alike.
///
/// What touches along an edge is parted between the wedges of the body, and moved from there by
/// a thousandth of an edge, so that it stays apart in every file. Nothing is done by which a
/// triangle would pass through another that did not before.
///
/// @param points       finite [m]
/// @param triangles    indices in range
/// @param largestHole  length around a hole that is closed [m]; 0: none
/// @throws Error       NoSolution: it is not wanted any longer, see checkWanted()
[[nodiscard]] RepairedMesh repairedMesh(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, double largestHole);

} // namespace palp
