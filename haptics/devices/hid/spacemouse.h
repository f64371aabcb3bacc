#pragma once

#include "haptics/devices/bytes.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace palp
{

/// What a six-axis mouse has last said of itself, in its own frame: x right, y to the user, z down.
struct SpaceMouseState
{
  std::array<std::int16_t, 6> axes{}; ///< x y z rx ry rz, about -350 to 350
  std::uint32_t buttons = 0;          ///< the first in bit 0
};

/// Takes up one input report: translation and rotation apart (7 bytes each) or together (13 bytes).
///
/// @return    false: not a report of motion or buttons, or cut short; the state is unchanged
/// @source    reports of SpaceNavigator and SpaceMouse Wireless as recorded by AndunHH/spacemouse
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] bool takeSpaceMouseReport(Bytes report, SpaceMouseState& state) noexcept;

/// How a deflection becomes a speed.
struct RateControl
{
  double speed = 0.060;   ///< at full deflection [m/s]
  double turning = 1.0;   ///< at full deflection [rad/s]
  double deadBand = 0.05; ///< fraction of the deflection that counts as rest
  double exponent = 2.0;  ///< above 1: finer near rest
};

/// Velocity of the tool in a frame with x right, y up the table, z up.
/// @return    [m/s], at most rate.speed along each axis
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d velocityOf(
  const SpaceMouseState& state, const RateControl& rate) noexcept;

/// Turning of the tool in the same frame.
/// @return    [rad/s], at most rate.turning about each axis
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d angularVelocityOf(
  const SpaceMouseState& state, const RateControl& rate) noexcept;

} // namespace palp
