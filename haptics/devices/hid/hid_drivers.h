#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/hid/phd1.h"
#include "haptics/devices/hid/spacemouse.h"
#include "haptics/devices/hid/wooden_haptics.h"

#include <array>
#include <memory>

namespace palp
{

/// A six-axis mouse that drives the tool at a rate; renders no force.
class SpaceMouseDriver final : public Driver
{
public:
  explicit SpaceMouseDriver(std::unique_ptr<Transport> transport, const RateControl& rate = {});

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Eigen::Vector3d& force, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Transport> transport_;
  RateControl rate_;
  SpaceMouseState state_;
  double silent_ = 0.0; // [s]
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
};

/// An arm of the WoodenHaptics family; needs its calibration button pressed in the rest position.
class WoodenDriver final : public Driver
{
public:
  /// @param reportSize  14 (mbed) or 64 (Teensy) [bytes]
  WoodenDriver(std::unique_ptr<Transport> transport, const WoodenArm& arm, std::size_t reportSize);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Eigen::Vector3d& force, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Transport> transport_;
  WoodenArm arm_;
  std::size_t reportSize_;
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();
  bool calibrate_ = false; // asked for by the board
  bool told_ = false;      // that it stands at rest
  bool homed_ = false;
};

/// A board that speaks PHD1.
class Phd1Driver final : public Driver
{
public:
  explicit Phd1Driver(std::unique_ptr<Transport> transport);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Eigen::Vector3d& force, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Transport> transport_;
  Phd1State state_;
  std::uint16_t sequence_ = 0;
};

} // namespace palp
