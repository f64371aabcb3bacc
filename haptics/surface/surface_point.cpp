#include "haptics/surface/surface_point.h"

#include "haptics/surface/ray.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// cosine of what a surface turns at an edge of the body itself, over which no normal is blended
constexpr double kEdge = 0.7;
constexpr int kMost = 100; // triangles each way: of a damaged mesh they may have no end

// of the triangles about a corner of one that no edge of the body parts from it
Eigen::Vector3d cornerNormal(const Surface& surface, int triangle, std::size_t corner)
{
  const int point = surface.triangles()[at(triangle)][corner];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  bool isParted = false;
  const auto normalOf = [&](int of)
  { return unitNormal(surface.points(), surface.triangles()[at(of)]); };
  const auto add = [&](int of, std::size_t k)
  {
    const Triangle& corners = surface.triangles()[at(of)];
    const Eigen::Vector3d& apex = surface.points()[at(point)];
    const Eigen::Vector3d u = surface.points()[at(corners[(k + 1) % 3])] - apex;
    const Eigen::Vector3d v = surface.points()[at(corners[(k + 2) % 3])] - apex;
    sum += std::atan2(u.cross(v).norm(), u.dot(v)) * normalOf(of);
  };
  add(triangle, corner);
  for (const std::size_t side :
    { std::size_t{ 0 }, std::size_t{ 2 } }) // both ways about the corner
  {
    int from = triangle;
    std::size_t k = corner;
    for (int n = 0; n < kMost; ++n)
    {
      const int next = surface.across(from, static_cast<int>((k + side) % 3));
      if (next == triangle)
      {
        return surface.normals()[at(point)];
      }
      if (next < 0)
      {
        break;
      }
      if (normalOf(next).dot(normalOf(from)) < kEdge)
      {
        isParted = true;
        break;
      }
      from = next;
      k = static_cast<std::size_t>(std::ranges::find(surface.triangles()[at(from)], point) -
        surface.triangles()[at(from)].begin());
      add(from, k);
    }
  }
  return isParted ? sum.normalized() : surface.normals()[at(point)];
}

} // namespace

SurfacePoint surfacePoint(const Surface& surface, int triangle, const Eigen::Vector3d& position)
{
  const Triangle& corners = surface.triangles()[static_cast<std::size_t>(triangle)];
  const auto point = [&](std::size_t k) -> const Eigen::Vector3d&
  { return surface.points()[static_cast<std::size_t>(corners[k])]; };
  const auto normal = [&](std::size_t k) { return cornerNormal(surface, triangle, k); };

  const Eigen::Vector3d u = point(1) - point(0);
  const Eigen::Vector3d v = point(2) - point(0);
  const Eigen::Vector3d w = position - point(0);
  const Eigen::Vector3d cross = u.cross(v);
  const double second = w.cross(v).dot(cross) / cross.squaredNorm();
  const double third = u.cross(w).dot(cross) / cross.squaredNorm();
  const Eigen::Vector3d blend =
    (1.0 - second - third) * normal(0) + second * normal(1) + third * normal(2);
  return { position, (blend.norm() > 0.0 ? blend : cross).normalized() };
}

std::optional<SurfacePoint> pick(
  const Surface& surface, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  const RayHit hit = rayEntry(surface.tree(), origin, direction);
  if (hit.triangle < 0)
  {
    return std::nullopt;
  }
  return surfacePoint(surface, hit.triangle, origin + hit.distance * direction);
}

} // namespace palp
