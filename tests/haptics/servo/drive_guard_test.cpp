// A press of an arm whose motors push as they are told, and of one whose motors push the other way.

#include "haptics/servo/guards/drive_guard.h"

#include "haptics/devices/velocity_estimator.h"
#include "tests/haptics/servo/safety_bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace test;

constexpr double kStep = 54.0_um;

DeviceLimits unproven()
{
  return { .model = "arm",
    .rendersForce = true,
    .maxForce = 5.0,
    .damping = 0.5,
    .friction = 0.05,
    .handDamping = kGripDamping,
    .quantum = kStep,
    .delay = 1.0_ms,
    .velocityDelay = 4.5_ms,
    .unproven = true };
}

// what came of a press into a tissue of 500 N/m, of places that an encoder of 54 um shows
struct Press
{
  explicit Press(const DeviceLimits& device = unproven())
    : bench(device)
    , velocity(kStep)
  {
    bench.orders.armed = true;
    for (int i = 0; i < 600; ++i)
    {
      look(-5.0_mm);
    }
    EXPECT_EQ(bench.chain.state(), DeviceState::Active);
  }

  void look(double depth)
  {
    const Vector3d seen(0, 0, -std::round(depth / kStep) * kStep);
    const Sample sample = bench.tick(ToolPose{ .apex = seen, .velocity = velocity(seen, kTick) });
    found = found || has(sample, Flag::DrivesMotion);
    most = std::max(most, sample.force.norm());
    felt += !found && sample.force.norm() >= DriveGuard::kFelt ? kTick : 0.0;
  }

  Bench bench;
  VelocityEstimator velocity;
  bool found = false;
  double most = 0.0; // force [N]
  double felt = 0.0; // for how long, until it was found [s]
};

// an arm of a mass that a hand pushes with a constant force, from 20 mm/s on
Press pushed(double mass, double hand, double sign, const DeviceLimits& device = unproven())
{
  Press press(device);
  double depth = -5.0_mm;
  double speed = 0.02;
  double late = 0.0; // force of the tick before
  for (int i = 0; i < 2000 && !press.found && depth < 0.1; ++i)
  {
    press.look(depth);
    for (int fine = 0; fine < 20; ++fine)
    {
      speed += (hand - sign * late - 0.5 * speed) / mass * kTick / 20.0;
      depth += speed * kTick / 20.0;
    }
    late = press.bench.force.z();
  }
  return press;
}

TEST(DriveGuard, FindsMotorsThatPushTheOtherWay)
{
  for (const double mass : { 0.05, 0.1, 0.2, 0.5 })
  {
    for (const double hand : { 0.2, 0.5, 1.0 })
    {
      const Press press = pushed(mass, hand, -1.0);
      EXPECT_TRUE(press.found) << mass << " kg, " << hand << " N";
      EXPECT_LE(press.most, 3.0) << mass << " kg, " << hand << " N";
      EXPECT_LE(press.felt, 0.06) << mass << " kg, " << hand << " N";
      EXPECT_EQ(press.bench.force, Vector3d(Vector3d::Zero()));
      EXPECT_EQ(press.bench.chain.state(), DeviceState::Ready);
    }
  }
}

TEST(DriveGuard, LeavesAnArmAloneThatPushesAsItIsTold)
{
  for (const double mass : { 0.1, 0.2, 0.5 })
  {
    for (const double hand : { 0.2, 0.5 })
    {
      EXPECT_FALSE(pushed(mass, hand, 1.0).found) << mass << " kg, " << hand << " N";
    }
  }
  DeviceLimits proven = unproven();
  proven.unproven = false; // it was measured
  EXPECT_FALSE(pushed(0.2, 0.3, -1.0, proven).found);
}

// whatever the force: reaches as hands make them, of least jerk, and palpation
TEST(DriveGuard, LeavesHandsAlone)
{
  using Depth = std::function<double(double time)>;
  const auto reach = [](double to, double within) -> Depth
  {
    return [=](double time)
    {
      const double part = std::clamp(time / within, 0.0, 1.0);
      return to * part * part * part * (10.0 - 15.0 * part + 6.0 * part * part);
    };
  };
  const auto palpates = [](double to, double rate) -> Depth
  {
    return [=](double time)
    { return 0.5 * to * (1.0 - std::cos(2.0 * std::numbers::pi * rate * time)); };
  };
  for (const Depth& depth : { reach(10.0_mm, 0.25), reach(10.0_mm, 0.5), reach(20.0_mm, 0.4),
         palpates(10.0_mm, 1.0), palpates(10.0_mm, 2.0), palpates(5.0_mm, 3.0) })
  {
    for (const double from : { 0.0, -3.0_mm })
    {
      Press press;
      for (double at = -5.0_mm; at < from; at += 0.02_mm)
      {
        press.look(at);
      }
      for (double time = 0.0; time < 2.0; time += kTick)
      {
        press.look(from + depth(time));
      }
      EXPECT_FALSE(press.found) << from << " " << press.most;
      EXPECT_GT(press.most, 0.5);
    }
  }
}

} // namespace
} // namespace palp
