#pragma once

#include "haptics/servo/safety.h"
#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp::test
{

using namespace units::literals;
using Eigen::Vector3d;

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr double kTick = 1.0_ms;
inline constexpr double kSlew = 0.5;      ///< [N] in a tick
inline constexpr double kSoftSlew = 0.05; ///< [N] in a tick

inline bool has(const Sample& sample, Flag flag)
{
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

inline DeviceLimits arm()
{
  return { .model = "arm", .rendersForce = true, .maxForce = 7.9, .damping = 2.0 };
}

/// The chain over the plane z = 0 of a given stiffness, pressed along -z.
struct Bench
{
  explicit Bench(const DeviceLimits& device = arm(), const SafetySettings& settings = {})
    : chain(device, settings)
  {
  }

  Sample tick(const std::optional<ToolPose>& pose, double dt = kTick)
  {
    Sample sample;
    const auto admitted = chain.admit(pose, status, orders, dt);
    if (admitted)
    {
      sample.pose = *admitted;
      const double depth = -admitted->apex.z();
      if (depth > 0.0)
      {
        sample.contact = { .depth = depth, .normal = Vector3d::UnitZ() };
      }
    }
    const auto law = [this](double depth) noexcept
    {
      return depth > 0.0 ? Response{ .force = stiffness * depth, .stiffness = stiffness }
                         : Response{};
    };
    chain.limit(sample, law, scene);
    force = sample.force;
    return sample;
  }

  Sample at(double depth, double dt = kTick)
  {
    return tick(ToolPose{ .apex = Vector3d(0, 0, -depth) }, dt);
  }

  /// Moves at a hand's speed, so that no step is implausible.
  Sample press(double depth)
  {
    Sample sample;
    for (; std::abs(depth - position) > 0.1_mm; position += std::copysign(0.1_mm, depth - position))
    {
      sample = at(position);
    }
    position = depth;
    return at(depth);
  }

  void activate()
  {
    orders.armed = true;
    for (int i = 0; i < 100; ++i)
    {
      (void)at(position);
    }
    ASSERT_EQ(chain.state(), DeviceState::Active);
  }

  SafetyChain chain;
  Scene scene;
  DeviceStatus status;
  SafetyOrders orders;
  double stiffness = 500.0;
  double position = -5.0_mm;
  Vector3d force = Vector3d::Zero();
};

} // namespace palp::test
