#include "app/press/surface_point.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace palp
{
namespace
{

// does a ray meet a box before a given distance?
bool meets(const BoxTree::Node& box, const Eigen::Vector3d& origin,
  const Eigen::Vector3d& direction, double before)
{
  double enter = 0.0;
  double leave = before;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto axis = static_cast<Eigen::Index>(k);
    const double a = (static_cast<double>(box.low[k]) - origin[axis]) / direction[axis];
    const double b = (static_cast<double>(box.high[k]) - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b)); // a NaN of 0/0 leaves both as they were
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

// distance along the ray to the front of a facet; infinity where it misses
// source: Moeller and Trumbore, Journal of Graphics Tools 2(1), 1997
double hit(const Facet& facet, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
{
  constexpr double kMiss = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d u = facet.corners[1] - facet.corners[0];
  const Eigen::Vector3d v = facet.corners[2] - facet.corners[0];
  const Eigen::Vector3d p = direction.cross(v);
  const double determinant = u.dot(p);
  if (!(determinant > 0.0)) // seen from behind or edge on
  {
    return kMiss;
  }
  const Eigen::Vector3d s = origin - facet.corners[0];
  const Eigen::Vector3d q = s.cross(u);
  const double a = s.dot(p);
  const double b = direction.dot(q);
  const double distance = v.dot(q) / determinant;
  return a >= 0.0 && b >= 0.0 && a + b <= determinant && distance >= 0.0 ? distance : kMiss;
}

} // namespace

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
  double nearest = std::numeric_limits<double>::infinity();
  int triangle = -1;
  surface.tree().search([&](const BoxTree::Node& box)
    { return meets(box, origin, direction, nearest); },
    [&](int facet)
    {
      const double distance =
        hit(surface.tree().facets()[static_cast<std::size_t>(facet)], origin, direction);
      if (distance < nearest)
      {
        nearest = distance;
        triangle = surface.tree().triangle(facet);
      }
    });
  if (triangle < 0)
  {
    return std::nullopt;
  }
  return surfacePoint(surface, triangle, origin + nearest * direction);
}

} // namespace palp
