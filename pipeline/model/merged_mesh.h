#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <span>
#include <vector>

namespace palp
{

/// Triangles that share their corners.
struct MergedMesh
{
  std::vector<Eigen::Vector3d> points; ///< each once, in order, in single precision; all are used
  std::vector<Triangle> triangles;     ///< of three different corners
  std::vector<int> from;               ///< of each triangle: which one of those given it was
};

/// Merges points that coincide, and leaves out those without a triangle as well as triangles
/// whose corners coincide.
///
/// @param points     finite
/// @param triangles  indices in range
[[nodiscard]] MergedMesh mergedMesh(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);

/// The same of those that are not left out.
/// @param isOut  of each triangle
[[nodiscard]] MergedMesh mergedWithout(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, const std::vector<bool>& isOut);

/// Which triangles stand between the same three points as an earlier one.
/// @param turned  whether also those that face the other way
[[nodiscard]] std::vector<bool> repeatedTriangles(
  std::span<const Triangle> triangles, bool turned = true);

} // namespace palp
