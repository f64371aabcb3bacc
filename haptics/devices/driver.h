#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/transport.h"

#include <Eigen/Geometry>

namespace palp
{

/// Driven joints of an arm: where they are and what pushes them.
struct DriverJoints
{
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  ///< as their encoders count [rad]
  Eigen::Vector3d torques = Eigen::Vector3d::Zero(); ///< of what was sent [N m]
};

/// What a driver has heard, in the frame of its device.
struct DriverSample
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the handle [m]
  /// Of the handle, unit: from a frame whose -z points from handle to apex. Identity: upright.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::uint32_t buttons = 0;
  bool homed = true;
  bool stopped = false; ///< by an emergency stop of the device's own
  double heat = 0.0;    ///< of the motors: 1 where they bear no more than their continuous current
  double temperature = 0; ///< of the motors as the device says it [deg C]; 0: it does not
  /// Of the force, what the motors were given after all limits of the driver [N], also where
  /// nothing came back; none: all of it.
  std::optional<Eigen::Vector3d> sent{};
  std::optional<DriverJoints> joints{}; ///< where a driver counts them itself
};

/// What one kind of device says and hears. Waits for its bus, a few milliseconds at most, on the
/// thread of the servo: see BusDevice.
class Driver
{
public:
  virtual ~Driver() = default;

  [[nodiscard]] virtual DeviceLimits limits() const = 0;

  /// Sends what to render, takes the newest that the device has said.
  ///
  /// @param wrench  of which a driver takes what its arm can render, most the force alone; nothing
  ///                reaches the motors before the device is homed
  /// @param dt      since the last tick [s]
  /// @param sample  unchanged unless Ok is returned, but for what was sent
  [[nodiscard]] virtual IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept = 0;
};

} // namespace palp
