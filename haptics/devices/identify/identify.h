#pragma once

#include "haptics/devices/arm.h"
#include "haptics/devices/driver.h"

#include <Eigen/Core>
#include <functional>
#include <optional>

namespace palp
{

/// Where an arm was, and when.
struct ArmPosition
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< in its own frame [m]
  double time = 0.0;                                  ///< [s]
  double sent = 0.0;                                  ///< when the force before it went out [s]
  std::optional<DriverJoints> joints{};               ///< where they are known one by one
};

/// Sends a force [N] and gives the position that came back, about a millisecond after the last;
/// nothing once the arm is gone or stopped.
using ArmExchange = std::function<std::optional<ArmPosition>(const Eigen::Vector3d& force)>;

/// Measures an arm that nobody holds: pushes it gently and sees how it moves. At most 60 s, 0.3 N,
/// and 25 mm to each side.
///
/// First one push along each axis, without any feedback: where the motion does not follow it, the
/// rest stays zero, as no wall that is rendered could hold. Then it swings along each axis between
/// two forces, and mass, friction and delay are fitted.
///
/// Where joints are told, one that is pushed by more than moved it before and does not count ends
/// it.
///
/// @param step    of its positions [m]
/// @throws Error  NoDevice: gone; an encoder hangs, leaps or is dead; moves by itself; does not
/// move for 0.3 N; what to do
[[nodiscard]] IdentifiedArm identifyArm(const ArmExchange& exchange, double step);

/// Newtons that a hand feels for one that is told, from an arm measured without and with a known
/// mass on its handle.
/// @param added   [kg]
/// @throws Error  BadValue: its masses do not differ by more than the measurement's own error
[[nodiscard]] double forceScale(
  const IdentifiedArm& without, const IdentifiedArm& with, double added);

} // namespace palp
