#pragma once

#include "haptics/devices/device.h"
#include "haptics/devices/transport.h"

namespace palp
{

/// What a driver has heard, in the frame of its device.
struct DriverSample
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< of the handle [m]
  std::uint32_t buttons = 0;
  bool homed = true;
  bool stopped = false; ///< by an emergency stop of the device's own
};

/// What one kind of device says and hears. May block for a few milliseconds, so it lives on a
/// thread of its own: see ThreadedDevice.
class Driver
{
public:
  virtual ~Driver() = default;

  [[nodiscard]] virtual DeviceLimits limits() const = 0;

  /// Sends a force, takes the newest that the device has said.
  ///
  /// @param force   [N]; no force reaches the motors before the device is homed
  /// @param dt      since the last tick [s]
  /// @param sample  unchanged unless Ok is returned
  [[nodiscard]] virtual IoCode tick(
    const Eigen::Vector3d& force, double dt, DriverSample& sample) noexcept = 0;
};

} // namespace palp
