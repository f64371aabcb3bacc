#include "haptics/surface/surface_point.h"

#include "haptics/surface/ray.h"

#include <Eigen/Geometry>

namespace palp
{

SurfacePoint surfacePoint(const Surface& surface, int triangle, const Eigen::Vector3d& position)
{
  const Triangle& corners = surface.triangles()[static_cast<std::size_t>(triangle)];
  const auto point = [&](std::size_t k) -> const Eigen::Vector3d&
  { return surface.points()[static_cast<std::size_t>(corners[k])]; };
  const auto normal = [&](std::size_t k) -> const Eigen::Vector3d&
  { return surface.normals()[static_cast<std::size_t>(corners[k])]; };

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
