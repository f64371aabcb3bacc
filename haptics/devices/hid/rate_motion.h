#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/hid/spacemouse.h"

namespace palp
{

/// A tool that a deflection moves and turns at a rate.
class RateMotion
{
public:
  explicit RateMotion(const RateControl& rate = {}) noexcept
    : rate_(rate)
  {
  }

  /// Moves the tool on.
  /// @param state  its deflections become rest once it has been silent for a tenth of a second: a
  ///               report of rest that was lost must not leave the tool drifting
  /// @param heard  something has come since the last time
  /// @param dt     [s]
  /// @realtime     no allocation, no lock, no exception
  [[nodiscard]] DriverSample move(SpaceMouseState& state, bool heard, double dt) noexcept;

private:
  RateControl rate_;
  double silent_ = 0.0; // [s]
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation_ = Eigen::Quaterniond::Identity();
};

} // namespace palp
