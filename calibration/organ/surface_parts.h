#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace palp
{

/// Cuts a triangle into parts whose edges are shorter than a length that grows with their distance
/// from a place, and calls use(corners) for each.
///
/// @param length  where they are near [m]
/// @param growth  of it by the distance [-]; 0: as short everywhere
template <typename Use>
void forPieces(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& place,
  double length, double growth, const Use& use)
{
  std::size_t longest = 0;
  std::array<double, 3> edges{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    edges[i] = (corners[(i + 1) % 3] - corners[i]).norm();
    longest = edges[i] > edges[longest] ? i : longest;
  }
  const Eigen::Vector3d& first = corners[longest];
  const Eigen::Vector3d& second = corners[(longest + 1) % 3];
  const Eigen::Vector3d& opposite = corners[(longest + 2) % 3];
  const Eigen::Vector3d middle = (first + second + opposite) / 3.0;
  if (edges[longest] <= std::max(length, growth * (middle - place).norm()))
  {
    use({ first, second, opposite });
    return;
  }
  const Eigen::Vector3d half = 0.5 * (first + second);
  forPieces({ first, half, opposite }, place, length, growth, use);
  forPieces({ half, second, opposite }, place, length, growth, use);
}

/// The same, and calls use(middle, area vector) for each.
template <typename Use>
void forParts(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& place,
  double length, double growth, const Use& use)
{
  forPieces(corners, place, length, growth,
    [&use](const std::array<Eigen::Vector3d, 3>& part)
    {
      const auto& [first, second, opposite] = part;
      use((first + second + opposite) / 3.0, 0.5 * (second - first).cross(opposite - first));
    });
}

/// The same of all triangles of a surface.
template <typename Use>
void forParts(const Surface& surface, const Eigen::Vector3d& place, double length, double growth,
  const Use& use)
{
  for (const auto& [a, b, c] : surface.triangles())
  {
    forParts({ surface.points()[at(a)], surface.points()[at(b)], surface.points()[at(c)] }, place,
      length, growth, use);
  }
}

} // namespace palp
