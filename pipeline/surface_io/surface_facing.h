#pragma once

#include "haptics/surface/edges.h"

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// Which triangles of a surface face the wrong way.
struct Facing
{
  std::vector<bool> turn;   ///< of each triangle
  std::size_t cavities = 0; ///< closed pieces that face a hollow within another
  std::vector<bool> within; ///< of each triangle: bounds nothing, as there is body on both sides
  std::size_t inner = 0;    ///< closed pieces of such
  bool twisted = false;     ///< one side goes over into the other, as of a Moebius strip
};

/// Triangles across an edge are to face the same way: as the first of their piece or, where the
/// surface is closed, away from the body. A piece within another that the file has facing the other
/// way bounds a hollow, and faces that; one that faces alike is a part of the other.
///
/// @param points  [m]
/// @param edges   of the triangles
[[nodiscard]] Facing facingOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, const Edges& edges);

} // namespace palp
