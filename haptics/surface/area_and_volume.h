#pragma once

#include "haptics/surface/box_tree.h"

#include <Eigen/Geometry>
#include <span>

namespace palp
{

/// Volume within a closed surface, by the divergence theorem; negative where it faces inward [unit
/// of the points^3].
[[nodiscard]] inline double enclosedVolume(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    volume += points[at(a)].dot(points[at(b)].cross(points[at(c)])) / 6.0;
  }
  return volume;
}

/// Of all triangles [unit of the points^2].
[[nodiscard]] inline double surfaceArea(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  double area = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d& corner = points[at(a)];
    area += 0.5 * (points[at(b)] - corner).cross(points[at(c)] - corner).norm();
  }
  return area;
}

} // namespace palp
