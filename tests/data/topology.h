#pragma once

#include "data/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace palp::test
{

/// Edges of a mesh, each once.
inline std::set<std::pair<int, int>> edgesOf(const Mesh& mesh)
{
  std::set<std::pair<int, int>> edges;
  for (const Triangle& t : mesh.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
    }
  }
  return edges;
}

/// True when every side of a triangle has exactly one partner, which runs the other way.
inline bool closedAndOriented(const Mesh& mesh)
{
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& t : mesh.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++sides[{ t[i], t[(i + 1) % 3] }];
    }
  }
  return std::all_of(sides.begin(), sides.end(),
    [&](const auto& side) {
      return side.second == 1 && sides.count({ side.first.second, side.first.first }) == 1;
    });
}

/// V - E + F: 2 for anything that deforms into a ball.
inline long euler(const Mesh& mesh)
{
  return static_cast<long>(mesh.points.size()) - static_cast<long>(edgesOf(mesh).size()) +
    static_cast<long>(mesh.triangles.size());
}

/// Enclosed volume [m^3], positive when the triangles face outwards; divergence theorem.
inline double volume(const Mesh& mesh)
{
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.0;
  }
  return sum;
}

/// [m^2]
inline double area(const Mesh& mesh)
{
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sum += (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]).norm() / 2.0;
  }
  return sum;
}

/// Smallest angle of any triangle [rad].
inline double smallestAngle(const Mesh& mesh)
{
  double smallest = std::numbers::pi;
  for (const Triangle& t : mesh.triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d u = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]];
      const Eigen::Vector3d v = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  }
  return smallest;
}

/// Sides of the bounding box [m].
inline Eigen::Vector3d extent(const Mesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.points)
  {
    box.extend(p);
  }
  return box.sizes();
}

/// Number of pieces that share no point.
inline int pieces(const Mesh& mesh)
{
  std::vector<int> root(mesh.points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i)
  {
    while (root[i] != i)
    {
      i = root[i] = root[root[i]];
    }
    return i;
  };
  for (const auto& [a, b] : edgesOf(mesh))
  {
    root[find(a)] = find(b);
  }
  int count = 0;
  for (std::size_t i = 0; i < root.size(); ++i)
  {
    count += root[i] == static_cast<int>(i);
  }
  return count;
}

} // namespace palp::test
