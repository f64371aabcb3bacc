#pragma once

#include "haptics/devices/arm.h"
#include "haptics/devices/driver.h"

#include <memory>

namespace palp
{

/// A driver whose arm was measured: its limits are those of this arm, its newtons those of a hand.
class IdentifiedDriver final : public Driver
{
public:
  IdentifiedDriver(std::unique_ptr<Driver> driver, const IdentifiedArm& arm);

  [[nodiscard]] DeviceLimits limits() const override;
  [[nodiscard]] IoCode tick(
    const Wrench& wrench, double dt, DriverSample& sample) noexcept override;

private:
  std::unique_ptr<Driver> driver_;
  IdentifiedArm arm_;
};

} // namespace palp
