#pragma once

#include "data/shapes.h"
#include "pipeline/health/mesh_health.h"
#include "pipeline/health/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <random>

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

/// Repaired, where a second repair finds nothing to do.
inline RepairedMesh repairedOf(const Mesh& mesh, double largestHole = 0.0)
{
  RepairedMesh mended = repairedMesh(mesh.points, mesh.triangles, largestHole);
  const RepairedMesh again = repairedMesh(mended.points, mended.triangles, largestHole);
  EXPECT_EQ(again.merged + again.removed + again.slivers + again.split, 0U);
  EXPECT_EQ(again.cut + again.filled + again.turned, 0U);
  EXPECT_EQ(again.triangles.size(), mended.triangles.size());
  return mended;
}

/// Each triangle with points of its own, off by up to a length [m].
inline Mesh soupOf(const Mesh& mesh, double off, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-off, off);
  Mesh soup;
  for (const Triangle& t : mesh.triangles)
  {
    const auto n = static_cast<int>(soup.points.size());
    for (const int corner : t)
    {
      soup.points.push_back(
        mesh.points[at(corner)] + Eigen::Vector3d(any(random), any(random), any(random)));
    }
    soup.triangles.push_back({ n, n + 1, n + 2 });
  }
  return soup;
}

/// The body stays whole, and what stands on it goes its own way.
inline void expectWhole(const Mesh& mesh, const MeshPiece& whole)
{
  const RepairedMesh mended = repairedOf(mesh);
  const std::vector<MeshPiece> pieces = healthOf(mended.points, mended.triangles).pieces;
  const auto body = std::ranges::max_element(pieces, {}, &MeshPiece::triangles);
  EXPECT_EQ(body->triangles, whole.triangles);
  EXPECT_TRUE(body->closed);
  EXPECT_NEAR(body->volume, whole.volume, 1e-4 * whole.volume);
}

} // namespace palp::test
