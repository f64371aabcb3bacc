#include "haptics/devices/identify/identified_driver.h"

#include <algorithm>
#include <utility>

namespace palp
{

IdentifiedDriver::IdentifiedDriver(std::unique_ptr<Driver> driver, const IdentifiedArm& arm)
  : driver_(std::move(driver))
  , arm_(arm)
{
}

DeviceLimits IdentifiedDriver::limits() const
{
  constexpr double kLeast = 0.01; // below what can be told from none [N s/m]
  DeviceLimits limits = driver_->limits();
  const auto& [x, y, z] = arm_.axes;
  limits.damping = arm_.scale * std::max(kLeast, std::min({ x.damping, y.damping, z.damping }));
  limits.friction = arm_.scale * std::min({ x.friction, y.friction, z.friction });
  limits.mass = arm_.scale * std::min({ x.mass, y.mass, z.mass });
  limits.quantum = arm_.encoderStep > 0.0 ? arm_.encoderStep : limits.quantum;
  limits.delay = std::max(limits.delay, arm_.delay);
  limits.maxForce *= arm_.scale;
  limits.unproven = false;
  return limits;
}

IoCode IdentifiedDriver::tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept
{
  const IoCode code = driver_->tick({ wrench.force / arm_.scale, wrench.torque }, dt, sample);
  if (sample.sent)
  {
    *sample.sent *= arm_.scale;
  }
  return code;
}

} // namespace palp
