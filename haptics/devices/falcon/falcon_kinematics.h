#pragma once

#include <Eigen/Core>
#include <optional>

namespace palp
{

/// Kinematics of a Novint Falcon: three legs on a base, a grip that stays parallel to it. The place
/// is in the frame of the base, z toward the user.

/// Angles of the three driven legs [rad] that hold the grip at a place [m].
/// @return    nothing: out of reach, or not finite
/// @source    own derivation; geometry of libnifalcon/libnifalcon FalconGeometry.h, as facts
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<Eigen::Vector3d> falconAngles(const Eigen::Vector3d& position) noexcept;

/// Derivative of those angles by the place [rad/m].
/// @return    nothing: out of reach, or in a singular pose
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<Eigen::Matrix3d> falconJacobian(
  const Eigen::Vector3d& position) noexcept;

/// Position of the grip for leg angles, by Newton's method on the angles.
/// @param near  a place close to it, as the last one
/// @return      nothing: not found in ten steps
/// @realtime    pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<Eigen::Vector3d> falconPosition(
  const Eigen::Vector3d& angles, const Eigen::Vector3d& near) noexcept;

/// Leg angle [rad] of an encoder, and where a search for the first place starts.
[[nodiscard]] double falconAngle(double counts) noexcept;
[[nodiscard]] Eigen::Vector3d falconCenter() noexcept;

/// Torques of the legs [N m] that push the hand with a force [N].
/// @return    nothing: out of reach, singular, or not finite
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] std::optional<Eigen::Vector3d> falconTorques(
  const Eigen::Vector3d& position, const Eigen::Vector3d& force) noexcept;

} // namespace palp
