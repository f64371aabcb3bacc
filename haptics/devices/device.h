#pragma once

#include "haptics/pose.h"
#include "haptics/wrench.h"

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>

namespace palp
{

/// Damping of a hand that holds a handle, unless identified [N s/m]: a sixth of the 6.45 that an
/// arm adds (van Beek et al. 2015, see HandMechanics), for a light grip.
inline constexpr double kGripDamping = 1.0;

/// From a frame with x to the user, y right, z up, as arms often have it, to that of
/// DeviceLimits::facing.
inline const Eigen::Matrix3d kFacesUser{ { 0.0, 1.0, 0.0 }, { -1.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } };

/// What a device can do and bear.
struct DeviceLimits
{
  std::string model;                ///< for people
  bool rendersForce = false;        ///< a hand can feel it
  bool needsHoming = false;         ///< its positions mean nothing until status().homed
  double maxForce = 0.0;            ///< [N]
  double maxTorque = 0.0;           ///< [N m]; 0: it renders none
  double maxAngularStiffness = 0.0; ///< that it may render [N m/rad]
  double damping = 0.0;         ///< b of the mechanism [N s/m], what makes a sampled wall stable
  double friction = 0.0;        ///< f_c of the mechanism, Coulomb's [N]
  double mass = 0.0;            ///< of the mechanism, as felt at its end [kg]; 0: unknown
  double handDamping = 0.0;     ///< that a hand on it adds at least [N s/m]
  double quantum = 0.0;         ///< smallest step of its position [m]
  double delay = 0.0;           ///< from a pose to its force, beyond the tick, until measured [s]
  double velocityDelay = 0.0;   ///< of the velocity in its poses [s]
  double workspaceRadius = 0.0; ///< how far it reaches [m]; 0: no bound
  Eigen::Vector3d workspaceCenter = Eigen::Vector3d::Zero(); ///< in the frame of its poses [m]
  bool unproven = false; ///< whether its motors push where they are told was never measured
  /// Motion of the tool by that of the hand, as it is placed; every length, speed and stiffness
  /// here is of the tool.
  double scale = 1.0;
  /// Of a driver: from its frame to one with x right, y away from the user, z up.
  Eigen::Matrix3d facing = Eigen::Matrix3d::Identity();
};

/// Where a device stands in the frame of the surface.
struct DevicePlacement
{
  static constexpr double kLargestScale = 5.0; ///< and its inverse the smallest

  /// From a frame with x right, y away from the user, z up: what drivers differ in is undone
  /// before.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< of the device's frame [m]
  double scale = 1.0; ///< motion of the tool by that of the hand; a newton stays one
  int clutch = 0;     ///< button that holds the tool while the hand goes elsewhere, from 1; 0: none
};

/// What a device says beside its pose.
struct DeviceStatus
{
  bool homed = true;
  bool stopped = false;                            ///< by an emergency stop of its own
  std::uint32_t buttons = 0;                       ///< a bit each, the first in bit 0
  double age = 0.0;                                ///< of the pose, since the hardware sent it [s]
  bool clutched = false;                           ///< its clutch is held: no force
  Eigen::Vector3d moved = Eigen::Vector3d::Zero(); ///< its frame, by its clutch, since limits() [m]
  double delay = 0.0; ///< from the last pose that was answered to its force [s]; 0: unknown
  double heat = 0.0;  ///< of the motors: 1 where they bear no more than their continuous current
  /// Of the force of this exchange, what the motors were given [N]; none: all of it.
  std::optional<Eigen::Vector3d> sent{};
};

class GuidedTool; // haptics/devices/simulated/guided_tool.h

/// One thing that holds the tool: a hand, an arm, a recorded path.
///
/// Set up and closed on the main thread; exchange() is called by one thread only.
class Device
{
public:
  virtual ~Device() = default;

  [[nodiscard]] virtual DeviceLimits limits() const = 0;

  /// Puts it somewhere else, with limits() of there; no servo may use it meanwhile.
  /// @return  false: it has no place of its own
  [[nodiscard]] virtual bool place(const DevicePlacement&)
  {
    return false;
  }

  /// One tick: takes what to render, gives the pose at its end. May wait for a bus.
  ///
  /// @param wrench  on the hand, finite; zero when off
  /// @param dt      since the last tick [s]
  /// @return        nothing when the device is gone
  /// @realtime      no allocation, no lock, no exception; a wait ends within a few milliseconds
  [[nodiscard]] virtual std::optional<ToolPose> exchange(
    const Wrench& wrench, double dt) noexcept = 0;

  /// Sends what answers the last pose at once, where the next exchange is too far off.
  /// @realtime  as exchange
  virtual void answer(const Wrench&) noexcept
  {
  }

  /// Holds the tool where it is while the hand goes elsewhere, as the button of its clutch does,
  /// for hands that have none free. Any thread; place() lets go.
  /// @realtime  no allocation, no lock, no exception
  virtual void hold(bool) noexcept
  {
  }

  /// How long an exchange waits for its bus, on average [s].
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] virtual double busTime() const noexcept
  {
    return 0.0;
  }

  /// What the main thread steers; null for a device that moves by itself.
  [[nodiscard]] virtual GuidedTool* guided() noexcept
  {
    return nullptr;
  }

  /// As of the last exchange.
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] virtual DeviceStatus status() const noexcept
  {
    return {};
  }
};

} // namespace palp
