#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/hid/motor_heat.h"
#include "haptics/devices/hid/phd1.h"
#include "haptics/devices/hid/rate_motion.h"
#include "haptics/devices/hid/wooden_haptics.h"
#include "haptics/devices/zero_packet.h"

#include <array>
#include <memory>
#include <vector>

namespace palp
{

/// A six-axis mouse that drives the tool at a rate; renders no force.
class SpaceMouseDriver final : public Driver
{
public:
  /// @param transports  one or more that may be it: a receiver shows an interface for each mouse
  ///                    that it could hear, and only one of them talks
  explicit SpaceMouseDriver(
    std::vector<std::unique_ptr<Transport>> transports, const RateControl& rate = {});
  explicit SpaceMouseDriver(std::unique_ptr<Transport> transport, const RateControl& rate = {});

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  std::vector<std::unique_ptr<Transport>> transports_;
  RateMotion motion_;
  SpaceMouseState state_;
};

inline constexpr std::size_t kWoodenReport = 14; ///< of an mbed board [bytes]

/// An arm of the WoodenHaptics family; needs its calibration button pressed in the rest position.
class WoodenDriver final : public Driver
{
public:
  /// @param reportSize  14 (mbed) or 64 (Teensy) [bytes]
  WoodenDriver(std::unique_ptr<Transport> transport, const WoodenArm& arm, std::size_t reportSize);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Transport> transport_;
  WoodenArm arm_;
  std::size_t reportSize_;
  MotorHeat heat_;
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity(); // of the handle
  bool calibrate_ = false;                                          // asked for by the board
  bool told_ = false;                                               // that it stands at rest
  bool button_ = false;
  bool homed_ = false;
};

/// A board that speaks PHD1. A report that repeats the last, as of a board that hangs, is none.
///
/// It is never told to move by itself: it is homed by hand, or by whoever asks for it with home().
class Phd1Driver final : public Driver
{
public:
  explicit Phd1Driver(std::unique_ptr<Transport> transport);

  /// From now on a board that is not homed is told to move there; its way must be free.
  void home() noexcept
  {
    homes_ = true;
  }

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Transport> transport_;
  Phd1State state_;
  bool heard_ = false; // anything yet
  bool homes_ = false;
  std::uint16_t sequence_ = 0;
};

/// What ends the force of each, as it stands on the wire.
[[nodiscard]] ZeroPacket woodenZero(std::size_t reportSize) noexcept;
[[nodiscard]] ZeroPacket phd1Zero() noexcept;

} // namespace palp
