#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace palp::test
{

using Mesh = std::pair<std::vector<Eigen::Vector3d>, std::vector<Triangle>>;

inline Surface makeSurface(Mesh mesh)
{
  return Surface(std::move(mesh.first), std::move(mesh.second));
}

/// Square sheet in z = height(x, y), n x n points, front towards +z, middle at the origin.
inline Mesh sheet(
  double size, int n,
  const std::function<double(double, double)>& height = [](double, double) { return 0.0; })
{
  Mesh mesh;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const double x = size * (static_cast<double>(i) / (n - 1) - 0.5);
      const double y = size * (static_cast<double>(j) / (n - 1) - 0.5);
      mesh.first.emplace_back(x, y, height(x, y));
    }
  }
  for (int j = 0; j + 1 < n; ++j)
  {
    for (int i = 0; i + 1 < n; ++i)
    {
      const int a = j * n + i;
      mesh.second.push_back({ a, a + 1, a + n + 1 });
      mesh.second.push_back({ a, a + n + 1, a + n });
    }
  }
  return mesh;
}

/// Closed surface over a cube whose 6 sides have n x n cells, each point moved by `shape`.
///
/// @param shape  from a point on the cube [-1, 1]^3 to its place [m]
inline Mesh cubeMap(int n, const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& shape)
{
  Mesh mesh;
  const auto side = static_cast<std::size_t>(n) + 1;
  std::vector<int> ids(side * side * side, -1);
  const auto point = [&](const std::array<int, 3>& c)
  {
    int& id = ids[(static_cast<std::size_t>(c[0]) * side + static_cast<std::size_t>(c[1])) * side +
      static_cast<std::size_t>(c[2])];
    if (id < 0)
    {
      id = static_cast<int>(mesh.first.size());
      mesh.first.push_back(
        shape(2.0 * Eigen::Vector3d(c[0], c[1], c[2]) / n - Eigen::Vector3d::Ones()));
    }
    return id;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const int end : { 0, n })
    {
      for (int i = 0; i < n; ++i)
      {
        for (int j = 0; j < n; ++j)
        {
          const auto corner = [&](int di, int dj)
          {
            std::array<int, 3> c{};
            c[axis] = end;
            c[(axis + 1) % 3] = i + di;
            c[(axis + 2) % 3] = j + dj;
            return point(c);
          };
          const std::array<int, 4> q = { corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1) };
          if (end == n)
          {
            mesh.second.push_back({ q[0], q[1], q[2] });
            mesh.second.push_back({ q[0], q[2], q[3] });
          }
          else
          {
            mesh.second.push_back({ q[0], q[2], q[1] });
            mesh.second.push_back({ q[0], q[3], q[2] });
          }
        }
      }
    }
  }
  return mesh;
}

/// Block centered in x and y whose top is z = 0.
inline Mesh block(const Eigen::Vector3d& size, int n)
{
  return cubeMap(n,
    [&](const Eigen::Vector3d& p)
    {
      return Eigen::Vector3d(
        0.5 * size.x() * p.x(), 0.5 * size.y() * p.y(), 0.5 * size.z() * (p.z() - 1.0));
    });
}

/// Sphere about the origin whose points are evenly spread over the sides of the cube.
inline Mesh ball(double radius, int n)
{
  return cubeMap(n,
    [&](const Eigen::Vector3d& p)
    {
      const Eigen::Vector3d tangents = (p.array() * (EIGEN_PI / 4.0)).tan();
      return Eigen::Vector3d(radius * tangents.normalized());
    });
}

/// About z, in along x around cells.
inline Mesh torus(double ring, double tube, int along, int around)
{
  Mesh mesh;
  for (int i = 0; i < along; ++i)
  {
    for (int k = 0; k < around; ++k)
    {
      const double u = 2.0 * M_PI * i / along;
      const double v = 2.0 * M_PI * k / around;
      const double radius = ring + tube * std::cos(v);
      mesh.first.emplace_back(radius * std::cos(u), radius * std::sin(u), tube * std::sin(v));
      const int next = (i + 1) % along * around;
      const int above = (k + 1) % around;
      mesh.second.push_back({ i * around + k, next + k, next + above });
      mesh.second.push_back({ i * around + k, next + above, i * around + above });
    }
  }
  return mesh;
}

inline Mesh moved(Mesh mesh, const Eigen::Vector3d& by)
{
  for (Eigen::Vector3d& point : mesh.first)
  {
    point += by;
  }
  return mesh;
}

/// The body and a copy of it beside it.
inline Mesh withCopyAt(Mesh mesh, const Eigen::Vector3d& shift)
{
  const Mesh one = mesh;
  const int size = static_cast<int>(one.first.size());
  for (const Eigen::Vector3d& point : one.first)
  {
    mesh.first.emplace_back(point + shift);
  }
  for (const Triangle& t : one.second)
  {
    mesh.second.push_back({ t[0] + size, t[1] + size, t[2] + size });
  }
  return mesh;
}

} // namespace palp::test
