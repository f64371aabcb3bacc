#pragma once

#include "haptics/devices/device.h"

namespace palp
{

/// Limits of the arm that the paper used, for motion that comes from no device.
///
/// The damping is the one at which the published largest stiffness of 1000 N/m is 0.7 of what a
/// loop of 1 kHz holds stable.
///
/// @source  PHANTOM Desktop of Sec. 5; 7.9 N and 1000 N/m: CHAI3D, CPhantomDevices.cpp
[[nodiscard]] inline DeviceLimits paperArm()
{
  return { .model = "PHANTOM Desktop", .rendersForce = true, .maxForce = 7.9, .damping = 0.714 };
}

} // namespace palp
