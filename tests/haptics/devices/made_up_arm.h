#pragma once

#include "haptics/devices/bus_device.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

namespace palp::test
{

using Eigen::Vector3d;
using namespace std::chrono_literals;

// what a made-up arm says and was told
struct Arm
{
  DriverSample says;
  DeviceLimits limits{ .model = "made up", .rendersForce = true, .maxForce = 4.0, .damping = 1.0 };
  Vector3d told = Vector3d::Zero();   // [N]
  Vector3d turned = Vector3d::Zero(); // [N m]
  std::atomic<int> ticks = 0;
};

class ArmDriver final : public Driver
{
public:
  explicit ArmDriver(Arm& arm)
    : arm_(arm)
  {
  }
  [[nodiscard]] DeviceLimits limits() const override
  {
    return arm_.limits;
  }
  [[nodiscard]] IoCode tick(const Wrench& wrench, double, DriverSample& sample) noexcept override
  {
    arm_.told = wrench.force;
    arm_.turned = wrench.torque;
    ++arm_.ticks;
    sample = arm_.says;
    return IoCode::Ok;
  }

private:
  Arm& arm_;
};

inline std::unique_ptr<BusDevice> placed(Arm& arm, const DevicePlacement& placement = {})
{
  return std::make_unique<BusDevice>(
    [&arm] { return std::make_unique<ArmDriver>(arm); }, placement);
}

// the watching thread may hold the driver for a tick of zero force, where a machine is busy
inline ToolPose exchangeUntilHeard(
  Device& device, const Arm& arm, const Vector3d& force = Vector3d::Zero())
{
  for (;;)
  {
    const int before = arm.ticks;
    const auto pose = device.exchange(force, 1e-3);
    if (pose && arm.ticks == before + 1 && std::abs(arm.told.norm() - force.norm()) < 1e-12)
    {
      return *pose;
    }
    std::this_thread::sleep_for(1ms);
  }
}

} // namespace palp::test
