#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/velocity_estimator.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace palp
{

/// A driver in the thread of the servo: one exchange sends a force and waits for the next pose.
///
/// So a force is late by an exchange and by the time of the servo step, and by nothing else. The
/// device measures that time, and how long the bus takes.
///
/// A second thread only watches: while no force has been renewed for 20 ms it sends zero, and a
/// device that was unplugged, or whose transfer failed, it closes, with zero force if it still
/// hears, and opens again when it is back. A new driver then knows nothing of the old one, so that
/// the device has to be homed anew. The last forces sent are zero.
///
/// While the button of its clutch is held the tool stays where it is: at once, or from where a
/// force has come to its end; the motion since then is left out of every later pose.
class BusDevice final : public Device
{
public:
  /// Opens the device; throws Error as long as it cannot be opened.
  using Open = std::function<std::unique_ptr<Driver>()>;

  /// Opens the device and waits for the first pose.
  /// @param open    called on the watching thread, twice a second, while the device is unplugged
  /// @throws Error  NoDevice: silent for a second, or gone; and what open throws
  BusDevice(Open open, const DevicePlacement& placement);

  /// Sends zero force; the servo must have ended.
  ~BusDevice() override;

  BusDevice(const BusDevice&) = delete;
  BusDevice& operator=(const BusDevice&) = delete;

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] bool place(const DevicePlacement& placement) override;
  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override;
  void answer(const Wrench& wrench) noexcept override;
  void hold(bool isHeld) noexcept override
  {
    heldByUser_ = isHeld;
  }
  [[nodiscard]] double busTime() const noexcept override
  {
    return busTime_;
  }
  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return status_;
  }

private:
  using Clock = std::chrono::steady_clock;

  /// Who may use the driver.
  enum class Owner
  {
    Nobody,
    User, ///< the servo in an exchange, or the watching thread that sends zero
    Lost, ///< the watching thread, until the device is back
  };

  [[nodiscard]] IoCode transfer(
    const Wrench& wrench, Clock::time_point begin, DriverSample& sample) noexcept;
  [[nodiscard]] IoCode tick(const Wrench& wrench, DriverSample& sample) noexcept;
  [[nodiscard]] bool takeDriver() noexcept;
  void releaseDriver(IoCode code) noexcept;
  void turn(double dt) noexcept;
  void index(bool rests) noexcept;
  [[nodiscard]] ToolPose pose() const noexcept;
  void watch(const std::stop_token& stop) noexcept;
  void endForce() noexcept;
  void reopen(const std::stop_token& stop) noexcept;

  Open open_;
  std::unique_ptr<Driver> driver_;          // its owner's; none while the device is unplugged
  Clock::time_point ticked_ = Clock::now(); // it was, by either thread; its owner's
  DeviceLimits limits_;
  DevicePlacement placement_;
  Eigen::Matrix3d rotation_; // of it, from the driver's own frame
  std::atomic<Owner> owner_ = Owner::Nobody;
  std::atomic<int> losses_ = 0;
  std::atomic<bool> heldByUser_ = false;                  // without a button of the device's
  std::atomic<Clock::time_point> renewed_ = Clock::now(); // the force, by the servo

  // of the servo's thread
  DeviceStatus status_;
  VelocityEstimator velocity_;
  DriverSample heard_;                               // last
  Eigen::Vector3d apex_ = Eigen::Vector3d::Zero();   // in the frame of the surface [m]
  Eigen::Vector3d speed_ = Eigen::Vector3d::Zero();  // of it [m/s]
  Eigen::Vector3d axis_ = -Eigen::Vector3d::UnitZ(); // of the tool, in its frame
  bool held_ = false;                                // by the clutch
  bool there_ = false;                               // has said where it is since it was opened
  int toldLosses_ = 0;                               // which the servo must not miss
  bool answered_ = true;                             // its last pose
  double busTime_ = 0.0;                             // [s], smoothed
  Clock::time_point asked_;                          // the transfer of the last pose began
  Clock::time_point when_;                           // and ended

  std::jthread watcher_; // last: it uses all the others
};

} // namespace palp
