#include "haptics/servo/safety.h"

#include "haptics/error.h"
#include "tests/haptics/servo/safety_bench.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;

TEST(SafetyChain, GivesTheLawWhereTheDeviceCanBearIt)
{
  Bench bench;
  bench.activate();
  const Sample sample = bench.press(5.0_mm);
  EXPECT_EQ(sample.force, Vector3d(0, 0, 500.0 * 5.0_mm));
  EXPECT_EQ(sample.proxyDepth, 5.0_mm);
  EXPECT_EQ(sample.flags, 0U);
}

TEST(SafetyChain, ForceIsBoundedInSizeAndKeepsItsDirection)
{
  Bench bench;
  bench.scene.forceLimit = 3.0;
  bench.activate();
  const Sample sample = bench.press(12.0_mm);
  EXPECT_NEAR(sample.force.norm(), 3.0, 1e-12);
  EXPECT_LT(sample.force.normalized().cross(Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_TRUE(has(sample, Flag::Limited));
}

// so the later stages cannot hide what they give from the observed energy
TEST(SafetyChain, LedgerCountsTheForceThatWasSentAfterEveryLimit)
{
  DeviceLimits device = arm();
  device.workspaceRadius = 8.0_mm; // deeper, its spring pushes too
  Bench bench(device);
  bench.stiffness = 20e3;
  bench.scene.forceLimit = 1.5;
  bench.activate();
  (void)bench.press(1.0_mm);
  double given = bench.chain.energy();
  double before = 1.0_mm;
  std::uint32_t flags = 0;
  for (int i = 1; i < 300; ++i)
  {
    const double depth = 1.0_mm + 5.0_mm * (1.0 - std::cos(i * 0.02));
    given += bench.force.z() * (depth - before); // of the last tick, held over this way
    before = depth;
    bench.status.age = i % 50 == 0 ? 10.0_ms : 0.0;
    flags |= bench.at(depth).flags;
    ASSERT_NEAR(bench.chain.energy(), given, 1e-12) << i;
    ASSERT_LE(bench.force.norm(), 1.5 * (1.0 + 1e-12)) << "tissue and workspace together";
  }
  for (const Flag flag :
    { Flag::StiffnessLimited, Flag::Limited, Flag::SlewLimited, Flag::Workspace })
  {
    EXPECT_NE(flags & static_cast<std::uint32_t>(flag), 0U) << static_cast<int>(flag);
  }
}

// what a driver's own limits have left of it is what the hand has felt
TEST(SafetyChain, LedgerCountsWhatTheDeviceSaysThatItGaveItsMotors)
{
  Bench bench;
  bench.activate();
  (void)bench.press(1.0_mm);
  double given = bench.chain.energy();
  double before = 1.0_mm;
  for (int i = 1; i < 300; ++i)
  {
    const double depth = 1.0_mm + 5.0_mm * (1.0 - std::cos(i * 0.02));
    bench.status.sent = Vector3d(0.3 * bench.force); // of the last tick
    given += 0.3 * bench.force.z() * (depth - before);
    before = depth;
    (void)bench.at(depth);
    ASSERT_NEAR(bench.chain.energy(), given, 1e-12) << i;
  }
}

TEST(SafetyChain, StiffnessFollowsThePeriodThatTheLoopReallyKeeps)
{
  Bench bench;
  EXPECT_NEAR(bench.chain.stiffnessLimit(0.0), 0.7 * 2.0 / 0.5_ms, 1e-6);
  for (int i = 0; i < 1000; ++i)
  {
    (void)bench.at(-5.0_mm, i % 50 == 0 ? 3.0_ms : kTick); // 2 % of the ticks
  }
  EXPECT_NEAR(bench.chain.stiffnessLimit(0.0), 0.7 * 2.0 / 1.5_ms, 0.05 * 0.7 * 2.0 / 1.5_ms);
}

TEST(SafetyChain, NeverPullsHoweverFastTheToolWithdraws)
{
  Bench bench;
  bench.scene.damping = 50.0;
  bench.activate();
  (void)bench.press(5.0_mm);
  for (double depth = 5.0_mm; depth > -1.0_mm; depth -= 1.0_mm)
  {
    const ToolPose pose{ .apex = Vector3d(0, 0, -depth), .velocity = Vector3d(0, 0, 1.0) };
    EXPECT_GE(bench.tick(pose).force.z(), 0.0);
  }
}

// what acts a tick late adds energy: beyond some damping it no longer brakes
TEST(SafetyChain, DampsAtMostTwiceAsMuchAsTheDeviceItself)
{
  Bench bench;
  bench.activate();
  (void)bench.press(5.0_mm);
  for (const double damping : { 3.0, 4.0, 50.0 })
  {
    bench.scene.damping = damping;
    const ToolPose pose{ .apex = Vector3d(0, 0, -5.0_mm), .velocity = Vector3d(0, 0, -0.1) };
    const Sample sample = bench.tick(pose);
    EXPECT_NEAR(sample.force.z(), 500.0 * 5.0_mm + std::min(damping, 4.0) * 0.1, 1e-12);
    EXPECT_EQ(has(sample, Flag::DampingLimited), damping > 4.0);
    EXPECT_NEAR(
      bench.chain.stiffnessLimit(damping), 0.7 * (2.0 + std::min(damping, 4.0)) / 0.5_ms, 1e-6);
  }
}

TEST(SafetyChain, ForceStepsAreBounded)
{
  Bench bench;
  bench.stiffness = 1e9;
  bench.activate();
  Vector3d before = bench.force;
  for (int i = 0; i < 4000; ++i)
  {
    (void)bench.at(-5.0_mm + 8.0_mm * std::abs(std::sin(i * 0.05)));
    ASSERT_LE((bench.force - before).norm(), kSlew * (1.0 + 1e-9)) << i;
    before = bench.force;
  }
}

TEST(SafetyChain, WorkspaceEndsInASoftSpringInward)
{
  DeviceLimits device = arm();
  device.workspaceRadius = 0.1;
  device.workspaceCenter = Vector3d(0, 0, 5.0_mm);
  Bench bench(device);
  bench.activate();
  Vector3d before = bench.force;
  for (int i = 0; i <= 300; ++i)
  {
    const Vector3d position(i * 0.5_mm, 0.0, 5.0_mm);
    const Sample sample =
      bench.tick(ToolPose{ .apex = position, .velocity = Vector3d(0.5, 0.0, 0.0) });
    ASSERT_EQ(has(sample, Flag::Workspace), i > 200) << i;
    ASSERT_LE((sample.force - before).norm(), kSlew * (1.0 + 1e-9)) << i;
    EXPECT_LE(sample.force.norm(), 2.0 + 1e-12);
    EXPECT_LE(sample.force.x(), 0.0);
    before = sample.force;
  }
  EXPECT_NEAR(before.x(), -2.0, 1e-12);
}

// where an arm may rest: that of a WoodenHaptics does
TEST(SafetyChain, ASoftStartBeyondTheWorkspaceIsAsSoftAsInTissue)
{
  DeviceLimits device = arm();
  device.workspaceRadius = 0.1;
  Bench bench(device);
  const ToolPose rest{ .apex = Vector3d(0, 0, 0.2) };
  for (int i = 0; i < 100; ++i)
  {
    (void)bench.tick(rest);
  }
  bench.orders.armed = true;
  double before = 0.0;
  for (int i = 0; i < 1000; ++i)
  {
    const Sample sample = bench.tick(rest);
    const double force = sample.force.norm();
    ASSERT_LE(force - before, kSoftSlew * (1.0 + 1e-9)) << i;
    ASSERT_LE(force, device.maxForce * i / 500.0 + 1e-9) << i;
    before = force;
  }
  EXPECT_NEAR(before, 2.0, 1e-6); // the whole of the wall
}

TEST(SafetyChain, DoesNotAllocate)
{
  Bench bench;
  bench.stiffness = 1e9;
  bench.activate();
  const test::AllocationGuard guard;
  (void)bench.press(3.0_mm);
  (void)bench.tick(std::nullopt);
  EXPECT_EQ(guard.count(), 0U);
}

TEST(SafetyChain, RefusesLimitsThatMakeNoSense)
{
  DeviceLimits device = arm();
  device.maxForce = kNaN;
  EXPECT_THROW(SafetyChain{ device }, Error);
  EXPECT_THROW((SafetyChain{ arm(), { .period = 0.0 } }), Error);
  // a force that is let go fades by what a soft start leaves of the rate: by nothing
  EXPECT_THROW((SafetyChain{ arm(), { .slewRate = 50.0, .softSlewRate = 50.0 } }), Error);
}

} // namespace
} // namespace palp
