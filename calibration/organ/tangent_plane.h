#pragma once

#include "haptics/surface/ray.h"
#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>
#include <optional>

namespace palp
{

/// Places on a surface, above or below those in its tangent plane at one.
class TangentPlane
{
public:
  TangentPlane(const Surface& surface, const Eigen::Vector3d& place, const Eigen::Vector3d& outward,
    double reach)
    : surface_(surface)
    , place_(place)
    , outward_(outward)
    , first_(outward.unitOrthogonal())
    , second_(outward.cross(first_))
    , reach_(reach)
  {
  }

  [[nodiscard]] Eigen::Vector3d vector(const Eigen::Vector2d& in) const
  {
    return in.x() * first_ + in.y() * second_;
  }

  [[nodiscard]] std::optional<Eigen::Vector3d> onSurface(const Eigen::Vector2d& at) const
  {
    const Eigen::Vector3d from = place_ + vector(at) + reach_ * outward_;
    const RayHit hit = rayEntry(surface_.tree(), from, -outward_);
    if (hit.triangle < 0 || hit.distance > 2.0 * reach_)
    {
      return std::nullopt;
    }
    const auto& [a, b, c] = surface_.triangles()[palp::at(hit.triangle)];
    const Eigen::Vector3d& corner = surface_.points()[palp::at(a)];
    const bool isAlike = facesAlike(
      (surface_.points()[palp::at(b)] - corner).cross(surface_.points()[palp::at(c)] - corner));
    return isAlike ? std::optional(Eigen::Vector3d(from - hit.distance * outward_)) : std::nullopt;
  }

  // else it is another side of the body, beyond an edge
  [[nodiscard]] bool facesAlike(const Eigen::Vector3d& area) const
  {
    return area.dot(outward_) > std::numbers::sqrt2 / 2.0 * area.norm();
  }

  // a vector seen from here, z into the body
  [[nodiscard]] Eigen::Vector3d inside(const Eigen::Vector3d& vector) const
  {
    return { vector.dot(first_), vector.dot(second_), -vector.dot(outward_) };
  }
  [[nodiscard]] Eigen::Vector3d outside(const Eigen::Vector3d& local) const
  {
    return local.x() * first_ + local.y() * second_ - local.z() * outward_;
  }

  [[nodiscard]] const Surface& surface() const
  {
    return surface_;
  }
  [[nodiscard]] const Eigen::Vector3d& place() const
  {
    return place_;
  }
  [[nodiscard]] const Eigen::Vector3d& outward() const
  {
    return outward_;
  }
  [[nodiscard]] double reach() const
  {
    return reach_;
  }

private:
  const Surface& surface_;
  Eigen::Vector3d place_;
  Eigen::Vector3d outward_;
  Eigen::Vector3d first_;
  Eigen::Vector3d second_;
  double reach_;
};

} // namespace palp
