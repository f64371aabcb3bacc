#pragma once

#include "haptics/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

/// The neighbors of every point of a triangle surface, in the order of its triangles.
///
/// A point's list holds chains of neighbors: a and b that follow one another make the triangle
/// (point, a, b), counter-clockwise from outside. A closed chain repeats its first neighbor at its
/// end; kEnd separates the chains of a point where more than two triangles meet at an edge.
/// About 32 bytes a point, and all that growing a region and computing a normal need.
class VertexRings
{
public:
  static constexpr std::int32_t kEnd = -1;

  VertexRings() = default;

  /// @param pointCount  number of points
  /// @param triangles   indices below pointCount; those that name a point twice are left out
  VertexRings(std::size_t pointCount, std::span<const Triangle> triangles);

  /// The chains of a point; empty where it has no triangle.
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] std::span<const std::int32_t> around(std::int32_t point) const noexcept
  {
    const auto at = static_cast<std::size_t>(point);
    return { chains_.data() + first_[at], chains_.data() + first_[at + 1] };
  }

  /// Memory in use [bytes].
  [[nodiscard]] std::size_t bytes() const noexcept
  {
    return first_.capacity() * sizeof(first_[0]) + chains_.capacity() * sizeof(chains_[0]);
  }

private:
  std::vector<std::uint32_t> first_{ 0 };
  std::vector<std::int32_t> chains_;
};

} // namespace palp
