#pragma once

#include <Eigen/Core>

namespace palp
{

/// A tool's axis turned part of the way to another, so that a target's jump becomes motion.
///
/// @param fraction  0: stays, 1: there
/// @return       unit vector; the target where the two are opposite
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] inline Eigen::Vector3d turned(
  const Eigen::Vector3d& axis, const Eigen::Vector3d& target, double fraction) noexcept
{
  constexpr double kShortest = 1e-3; // below it the direction between the two means nothing
  const Eigen::Vector3d between = axis + fraction * (target - axis);
  const double length = between.norm();
  return length > kShortest ? Eigen::Vector3d(between / length) : target;
}

/// What is left of a vector without its part along a unit vector.
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] inline Eigen::Vector3d across(
  const Eigen::Vector3d& vector, const Eigen::Vector3d& direction) noexcept
{
  return vector - vector.dot(direction) * direction;
}

} // namespace palp
