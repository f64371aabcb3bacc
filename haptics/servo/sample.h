#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"

#include <Eigen/Core>
#include <cstdint>

namespace palp
{

/// What limited or stopped the force of a sample; a set of bits.
enum class Flag : std::uint32_t
{
  None = 0,
  NotFinite = 1,  ///< a value was not finite; the force is zero
  Limited = 2,    ///< shortened to the force limit
  Disarmed = 4,   ///< force off until the user arms the device
  EmergencyStop = 8,
  DeviceLost = 16,
};

/// One turn of the servo loop: what was read, what was found, what was sent.
struct Sample
{
  double time = 0.0; ///< since the start of the loop [s]
  ToolPose pose;
  Contact contact;
  Response response;                               ///< of the law, before damping and limits
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< sent to the device [N]
  std::uint32_t flags = 0;                         ///< of Flag
};

} // namespace palp
