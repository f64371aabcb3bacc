#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/force_law.h"
#include "haptics/pose.h"

#include <Eigen/Core>
#include <cstdint>

namespace palp
{

/// What limited or stopped the force of a sample; a set of bits.
enum class Flag : std::uint32_t
{
  None = 0,
  NotFinite = 1,     ///< a value was not finite; the force is zero
  Limited = 2,       ///< shortened to the force limit
  Disarmed = 4,      ///< force off until the user arms the device
  EmergencyStop = 8, ///< force off until the user takes the stop back and arms again
  DeviceLost = 16,
  Jump = 32,               ///< the pose moved faster than a hand can
  Stale = 64,              ///< the device has been silent too long
  NotHomed = 128,          ///< its positions mean nothing yet
  Late = 256,              ///< ticks come so late that the force starts again, or ends
  StiffnessLimited = 512,  ///< the law is stiffer here than the device can render
  Passivity = 1024,        ///< damped, because the loop had given out energy
  SlewLimited = 2048,      ///< the force rises or falls more slowly than asked
  Workspace = 4096,        ///< pushed back from the end of the device's reach
  Rebased = 8192,          ///< contact is felt from a depth below the surface, until the tool lifts
  WatchdogExpired = 16384, ///< the main thread is silent: the force fades until it is back
  DampingLimited = 32768,  ///< the law damps more than the device can render
  Clutched = 65536,        ///< the tool stays while the hand goes elsewhere; no force
  MotorsWarm = 131072,     ///< soon they bear no more than their continuous current
  DrivesMotion = 262144,   ///< the force speeds up what it should brake
};

/// Where a device stands between closed and felt.
enum class DeviceState : std::uint8_t
{
  Closed,      ///< gone, or not yet opened
  Opening,     ///< its first pose has come
  NeedsHoming, ///< only zero force until the user has homed it
  Ready,       ///< force off, may be armed
  SoftStart,   ///< force grows from zero
  Active,
  Decay, ///< force falls to zero
};

/// True when flags hold a fault that ends the force until the device is armed anew.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr bool isFault(DeviceState state, std::uint32_t flags) noexcept
{
  constexpr std::uint32_t kFaults = static_cast<std::uint32_t>(Flag::EmergencyStop) |
    static_cast<std::uint32_t>(Flag::NotFinite) | static_cast<std::uint32_t>(Flag::DeviceLost) |
    static_cast<std::uint32_t>(Flag::Stale) | static_cast<std::uint32_t>(Flag::Jump) |
    static_cast<std::uint32_t>(Flag::Late) | static_cast<std::uint32_t>(Flag::DrivesMotion);
  return (state == DeviceState::Closed || state == DeviceState::Ready) && (flags & kFaults) != 0;
}

/// One turn of the servo loop: what was read, what was found, what was sent.
struct Sample
{
  double time = 0.0; ///< since the start of the loop [s]
  ToolPose pose;
  Contact contact;
  int organ = 0;     ///< of the scene, that is touched, or was last; 0: the first, or the only one
  Response response; ///< of the law, before damping and limits
  Eigen::Vector3d lateral = Eigen::Vector3d::Zero(); ///< of what lies in the tissue [N]
  double localDepth = 0.0; ///< of the contact, without what the body gives way as a whole [m]
  double proxyDepth = 0.0; ///< depth at which the law gives the rendered force [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();    ///< sent to the device [N]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();   ///< likewise, about the apex [N m]
  Eigen::Vector3d friction = Eigen::Vector3d::Zero(); ///< on the tool, before limits [N]
  double surfaceDepth = 0.0; ///< of relaxing tissue at the tool, also of what is left [m]
  std::uint32_t flags = 0;   ///< of Flag
  DeviceState state = DeviceState::Active;
  Eigen::Vector3d moved = Eigen::Vector3d::Zero(); ///< the device's frame, by its clutch [m]
};

} // namespace palp
