#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
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

/// Height of a triangle over its longest edge, 0 to 0.87; 0 where it has no edge [-].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline double flatness(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) noexcept
{
  const double longest =
    std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() });
  return longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0;
}

/// What holds all points; empty where there are none.
[[nodiscard]] inline Eigen::AlignedBox3d boxAbout(std::span<const Eigen::Vector3d> points)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
  {
    box.extend(point);
  }
  return box;
}

} // namespace palp
