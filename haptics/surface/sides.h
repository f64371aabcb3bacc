#pragma once

#include "haptics/surface/box_tree.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// One side of a triangle, from its corner k to corner k + 1, kept at the lower of its two points.
struct Side
{
  int other; ///< the higher point
  int triangle;
  int k;
};

/// The sides of all triangles with three different corners, those of one edge next to each other.
struct Sides
{
  std::vector<int> first; ///< of each point in all; #points + 1
  std::vector<Side> all;  ///< at each point by the higher one
};

/// O(n log n) for any triangles.
/// @param triangles  indices below points
[[nodiscard]] Sides sidesByPoint(std::size_t points, std::span<const Triangle> triangles);

/// Calls visit(lower point, sides of the edge) once for each edge.
template <typename Visit>
void forEachEdge(const Sides& sides, Visit visit)
{
  const std::span<const Side> all(sides.all);
  for (std::size_t point = 0; point + 1 < sides.first.size(); ++point)
  {
    const auto end = static_cast<std::size_t>(sides.first[point + 1]);
    for (auto side = static_cast<std::size_t>(sides.first[point]); side < end;)
    {
      std::size_t next = side + 1;
      while (next < end && all[next].other == all[side].other)
      {
        ++next;
      }
      visit(static_cast<int>(point), all.subspan(side, next - side));
      side = next;
    }
  }
}

} // namespace palp
