#include "pipeline/motion/moved_surface.h"

#include <cmath>
#include <utility>

namespace palp
{
namespace
{

using Lanes = OrganMotion::Lanes;

Lanes lanesAt(const float* three) noexcept
{
  return Lanes{ three[0], three[1], three[2], 0.0F };
}

void put(Lanes lanes, float* three) noexcept
{
  three[0] = lanes[0];
  three[1] = lanes[1];
  three[2] = lanes[2];
}

} // namespace

MovedSurface::MovedSurface(std::shared_ptr<const OrganMotion> motion, std::span<const float> rest)
  : motion_(std::move(motion))
  , rest_(rest)
{
  weights_.reserve(rest.size() / 3);
  for (std::size_t i = 0; i < rest.size(); i += 3)
  {
    weights_.push_back(motion_->weightsAt(vectorOf(lanesAt(rest.data() + i))));
  }
}

void MovedSurface::load(std::span<const OrganLoad> loads)
{
  motion_->move(loads, moved_);
}

void MovedSurface::move(
  const float* displacement, const float* normals, const MovedArrays& all) const noexcept
{
  for (std::size_t i = 0; i < weights_.size(); ++i)
  {
    const std::size_t at = 3 * i;
    const OrganMotion::Moved moved = OrganMotion::blend(weights_[i], moved_);
    const Lanes by = moved.move + turned(lanesAt(displacement + at), moved.turn);
    const Lanes normal = turned(lanesAt(normals + at), moved.turn);
    const float length = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
    put(by, all.displacement + at);
    put(lanesAt(rest_.data() + at) + by, all.points + at);
    put(normal * (length > 0.0F ? 1.0F / std::sqrt(length) : 0.0F), all.normals + at);
  }
}

} // namespace palp
