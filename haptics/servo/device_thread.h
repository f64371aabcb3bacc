#pragma once

#include "haptics/devices/device.h"
#include "haptics/servo/latest.h"

#include <chrono>
#include <memory>
#include <optional>
#include <thread>

namespace palp
{

/// A device whose transport can block, made safe for the servo thread by a thread of its own.
///
/// That thread exchanges with the device as fast as the device answers; the servo takes the newest
/// pose and leaves the newest force, wait-free. A force that the servo has not renewed for 20 ms
/// is no longer sent, and the last one sent is zero.
class DeviceThread final : public Device
{
public:
  /// @param device   used by the new thread alone
  /// @param fastest  shortest time between two exchanges, for a device that does not block
  explicit DeviceThread(std::unique_ptr<Device> device,
    std::chrono::nanoseconds fastest = std::chrono::microseconds(250));

  /// Ends with zero force; waits for the exchange under way.
  ~DeviceThread() override;

  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  [[nodiscard]] DeviceLimits limits() const override
  {
    return limits_;
  }
  [[nodiscard]] std::optional<ToolPose> exchange(
    const Eigen::Vector3d& force, double dt) noexcept override;

  /// The age of the pose counts from the moment the transport gave it.
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return status_;
  }

private:
  using Clock = std::chrono::steady_clock;

  struct Command
  {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(); // [N]
    Clock::time_point given;
  };
  struct Answer
  {
    std::optional<ToolPose> pose;
    DeviceStatus status;
    Clock::time_point taken;
    bool first = true; // the device has not answered yet
  };

  void run(const std::stop_token& stop) noexcept;

  std::unique_ptr<Device> device_;
  DeviceLimits limits_;
  std::chrono::nanoseconds fastest_;
  DeviceStatus status_; // servo thread's
  Latest<Command> command_;
  Latest<Answer> answer_;
  std::jthread thread_; // last: it uses all the others
};

} // namespace palp
