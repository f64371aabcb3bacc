#pragma once

#include "data/shapes.h"

#include <Eigen/Geometry>

namespace palp::test
{

inline void add(Mesh& mesh, const Mesh& other, const Eigen::Vector3d& offset)
{
  const auto first = static_cast<int>(mesh.points.size());
  for (const Eigen::Vector3d& point : other.points)
  {
    mesh.points.push_back(point + offset);
  }
  for (const auto& [a, b, c] : other.triangles)
  {
    mesh.triangles.push_back({ first + a, first + b, first + c });
  }
}

/// The unit cube [m], of two triangles a side.
inline Mesh cube()
{
  return makeBox(Eigen::Vector3d::Ones(), 1.0);
}

/// By the divergence theorem [m^3].
inline double volumeOf(
  const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  double volume = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    volume += points[at(a)].dot(points[at(b)].cross(points[at(c)])) / 6.0;
  }
  return volume;
}

} // namespace palp::test
