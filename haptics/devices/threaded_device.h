#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/velocity_estimator.h"
#include "haptics/servo/latest.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

namespace palp
{

/// Where a device stands in the frame of the surface.
struct DevicePlacement
{
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< from the device's frame
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();       ///< of the device's frame [m]
};

/// Runs a driver on a thread of its own, so that a slow bus cannot hold the servo loop.
///
/// A command that is not renewed for 20 ms is taken for zero, and the last ones sent are zero.
class ThreadedDevice final : public Device
{
public:
  /// Starts the thread and waits for the first pose.
  /// @throws Error  NoDevice: silent for a second, or gone
  ThreadedDevice(std::unique_ptr<Driver> driver, const DevicePlacement& placement);

  /// Stops the thread, with zero force.
  ~ThreadedDevice() override;

  ThreadedDevice(const ThreadedDevice&) = delete;
  ThreadedDevice& operator=(const ThreadedDevice&) = delete;

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept override;
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return status_;
  }

private:
  using Clock = std::chrono::steady_clock;

  struct Heard
  {
    DriverSample sample;
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero(); // [m/s]
    Clock::time_point when;
  };

  struct Wanted
  {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(); // in the device's frame [N]
    Clock::time_point when;
  };

  void run(const std::stop_token& stop) noexcept;

  std::unique_ptr<Driver> driver_;
  DevicePlacement placement_;
  DeviceStatus status_;
  Latest<Heard> heard_;
  Latest<Wanted> wanted_;
  std::atomic<bool> spoke_ = false;
  std::atomic<bool> gone_ = false;
  std::jthread thread_; // last: it uses all the others
};

} // namespace palp
