#pragma once

#include "haptics/force/series/organ_motion.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace palp
{

/// Arrays of a surface, three floats a point.
struct MovedArrays
{
  float* points;       ///< [m]
  float* normals;      ///< unit, outward
  float* displacement; ///< from rest [m]
};

/// The points of a surface, moved with the body that they are on.
class MovedSurface
{
public:
  MovedSurface() = default;

  /// @param motion  not null
  /// @param rest    three floats a point [m], borrowed
  MovedSurface(std::shared_ptr<const OrganMotion> motion, std::span<const float> rest);

  /// Whether it is of this motion.
  [[nodiscard]] bool isOf(const OrganMotion* motion) const noexcept
  {
    return motion_.get() == motion;
  }

  /// What all loads together move, until the next call.
  void load(std::span<const OrganLoad> loads);

  /// Moves every point, with the dent that is in it; a dent turns as the surface below it.
  /// @param displacement  by the dent, three floats a point [m]
  /// @param normals       with the dent, likewise
  /// @param all           replaced
  void move(const float* displacement, const float* normals, const MovedArrays& all) const noexcept;

  /// How a point of the surface is moved.
  [[nodiscard]] OrganMotion::Moved at(std::int32_t point) const noexcept
  {
    return OrganMotion::blend(weights_[static_cast<std::size_t>(point)], moved_);
  }

private:
  std::shared_ptr<const OrganMotion> motion_;
  std::span<const float> rest_;
  std::vector<OrganMotion::Weights> weights_; // of each point
  std::vector<OrganMotion::Moved> moved_;     // of each place of the motion
};

/// A vector on the surface of a body, after the body has turned.
[[nodiscard]] inline OrganMotion::Lanes turned(
  OrganMotion::Lanes vector, OrganMotion::Lanes turn) noexcept
{
  const auto next = [](OrganMotion::Lanes v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  return vector + next(turn * next(vector) - next(turn) * vector);
}

} // namespace palp
