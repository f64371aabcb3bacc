#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/velocity_estimator.h"
#include "haptics/threads/latest.h"

#include <atomic>
#include <chrono>
#include <functional>
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
/// A command that is not renewed for 20 ms is taken for zero, and the last ones sent are zero. A
/// device that was unplugged, or whose transfer failed, is closed, with zero force if it still
/// hears, and opened again when it is back: a new driver then knows nothing of the old one, so that
/// the device has to be homed anew.
class ThreadedDevice final : public Device
{
public:
  /// Opens the device; throws Error as long as it cannot be opened.
  using Open = std::function<std::unique_ptr<Driver>()>;

  /// Opens the device here, starts the thread and waits for the first pose.
  /// @param open    called on the thread, twice a second, while the device is unplugged
  /// @throws Error  NoDevice: silent for a second, or gone; and what open throws
  ThreadedDevice(Open open, const DevicePlacement& placement);

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
  void serve(const std::stop_token& stop) noexcept;
  void endForce() noexcept;
  void reopen(const std::stop_token& stop) noexcept;

  Open open_;
  std::unique_ptr<Driver> driver_; // the thread's; none while the device is unplugged
  DeviceLimits limits_;
  DevicePlacement placement_;
  DeviceStatus status_;
  Latest<Heard> heard_;
  Latest<Wanted> wanted_;
  std::atomic<bool> there_ = false; // has said where it is since it was opened
  std::atomic<int> losses_ = 0;
  int toldLosses_ = 0;  // to the servo, which must not miss a short one
  std::jthread thread_; // last: it uses all the others
};

} // namespace palp
