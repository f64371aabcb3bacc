#include "tests/haptics/servo/safety_bench.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;

TEST(SafetyChain, IsSilentUntilItIsArmed)
{
  Bench bench;
  const Sample sample = bench.press(5.0_mm);
  EXPECT_EQ(sample.force, Vector3d::Zero());
  EXPECT_NEAR(sample.response.force, 2.5, 1e-12); // what it would be is known all the same
  EXPECT_EQ(sample.state, DeviceState::Ready);
  EXPECT_TRUE(has(sample, Flag::Disarmed));
}

TEST(SafetyChain, StartsFromZeroInContactAndGently)
{
  for (const double stiffness : { 500.0, 1e9 })
  {
    Bench bench;
    bench.stiffness = stiffness;
    (void)bench.press(5.0_mm);
    bench.orders.armed = true;
    EXPECT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
    EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
    Vector3d before = bench.force;
    int ticks = 1;
    for (; bench.chain.state() == DeviceState::SoftStart; ++ticks)
    {
      (void)bench.at(5.0_mm + 1.0_mm * std::sin(ticks * 0.1));
      ASSERT_LE((bench.force - before).norm(), kSoftSlew * (1.0 + 1e-9)) << ticks;
      before = bench.force;
      ASSERT_LT(ticks, 1000);
    }
    EXPECT_GE(ticks * kTick, 0.5 - 2 * kTick);
  }
}

// a start in contact feels nothing at first: that, too, is said
TEST(SafetyChain, SaysThatContactIsFeltFromBelowTheSurfaceUntilTheToolHasLifted)
{
  Bench bench;
  (void)bench.press(5.0_mm);
  bench.orders.armed = true;
  for (int i = 0; i < 700; ++i)
  {
    ASSERT_TRUE(has(bench.at(5.0_mm), Flag::Rebased)) << "tick " << i;
  }
  EXPECT_EQ(bench.force, Vector3d::Zero());
  EXPECT_TRUE(has(bench.press(8.0_mm), Flag::Rebased));
  EXPECT_FALSE(has(bench.press(-1.0_mm), Flag::Rebased));
  EXPECT_FALSE(has(bench.press(5.0_mm), Flag::Rebased));
  EXPECT_GT(bench.force.z(), 0.0);
}

TEST(SafetyChain, FreeSpaceEndsASoftStart)
{
  Bench bench;
  bench.orders.armed = true;
  int ticks = 0;
  for (; bench.chain.state() != DeviceState::Active; ++ticks)
  {
    (void)bench.at(-5.0_mm);
    ASSERT_LT(ticks, 1000);
  }
  EXPECT_NEAR(ticks * kTick, 50.0_ms, 2.0_ms);
}

TEST(SafetyChain, EmergencyStopIsImmediateAndLatched)
{
  Bench bench;
  bench.activate();
  ASSERT_GT(bench.press(5.0_mm).force.z(), 0.0);
  bench.orders.stop = true;
  EXPECT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
  bench.orders.stop = false;
  for (int i = 0; i < 1000; ++i)
  {
    ASSERT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
  }
  bench.orders.armed = false;
  EXPECT_TRUE(has(bench.at(5.0_mm), Flag::EmergencyStop)); // says why until it is armed again
  bench.orders.armed = true;
  EXPECT_FALSE(has(bench.at(5.0_mm), Flag::EmergencyStop));
  EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
}

// as a window does it: stop with disarm, then both taken back between two ticks
TEST(SafetyChain, ArmsAgainInTheTickThatTakesTheStopBack)
{
  Bench bench;
  bench.activate();
  bench.orders = { .armed = false, .stop = true };
  (void)bench.at(-5.0_mm);
  bench.orders = { .armed = true, .stop = false };
  (void)bench.at(-5.0_mm);
  EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
}

TEST(SafetyChain, ReleasingAStopAloneArmsNothing)
{
  Bench bench;
  bench.orders = { .armed = true, .stop = true };
  (void)bench.at(-5.0_mm);
  bench.orders.stop = false;
  for (int i = 0; i < 100; ++i)
  {
    ASSERT_EQ(bench.at(-5.0_mm).state, DeviceState::Ready);
  }
}

TEST(SafetyChain, StopHoldsAgainstDisarmingAndArming)
{
  Bench bench;
  bench.orders.stop = true;
  for (int i = 0; i < 200; ++i)
  {
    bench.orders.armed = i % 3 != 0;
    ASSERT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
    ASSERT_EQ(bench.chain.state(), DeviceState::Ready);
  }
}

// brings a chain into each state
class UnpluggedIn : public ::testing::TestWithParam<DeviceState>
{
protected:
  void reach(DeviceState state)
  {
    bench_.status.homed = state != DeviceState::NeedsHoming;
    if (state == DeviceState::Closed)
    {
      return;
    }
    if (state >= DeviceState::Active)
    {
      bench_.activate();
    }
    (void)bench_.press(5.0_mm);
    bench_.orders.armed = state == DeviceState::SoftStart || state == DeviceState::Active;
    (void)bench_.at(5.0_mm);
    (void)bench_.at(5.0_mm);
  }

  static DeviceLimits limits()
  {
    DeviceLimits device = arm();
    device.needsHoming = true;
    return device;
  }

  Bench bench_{ limits() };
};
INSTANTIATE_TEST_SUITE_P(SafetyChain, UnpluggedIn,
  ::testing::Values(DeviceState::Closed, DeviceState::NeedsHoming, DeviceState::Ready,
    DeviceState::SoftStart, DeviceState::Active, DeviceState::Decay));

TEST_P(UnpluggedIn, GivesNoForceUntilItIsBackHomedAndArmedAnew)
{
  reach(GetParam());
  ASSERT_EQ(bench_.chain.state(), GetParam());
  const Sample gone = bench_.tick(std::nullopt);
  EXPECT_EQ(gone.force, Vector3d::Zero());
  EXPECT_EQ(gone.state, DeviceState::Closed);
  EXPECT_TRUE(has(gone, Flag::DeviceLost));

  bench_.orders.armed = true; // an old wish, or one for a device that is not there
  (void)bench_.tick(std::nullopt);
  bench_.status.homed = false;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(bench_.at(5.0_mm).force, Vector3d::Zero());
    ASSERT_EQ(bench_.chain.state(), DeviceState::NeedsHoming);
  }
  bench_.status.homed = true;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(bench_.at(5.0_mm).force, Vector3d::Zero());
    ASSERT_EQ(bench_.chain.state(), DeviceState::Ready);
  }
  bench_.orders.armed = false;
  (void)bench_.at(5.0_mm);
  bench_.orders.armed = true;
  EXPECT_EQ(bench_.at(5.0_mm).force, Vector3d::Zero()); // softly, from nothing
  EXPECT_EQ(bench_.chain.state(), DeviceState::SoftStart);
  for (int i = 0; i < 1000; ++i)
  {
    (void)bench_.at(5.0_mm);
  }
  bench_.position = 5.0_mm;
  EXPECT_GT(bench_.press(6.0_mm).force.norm(), 0.0);
}

TEST(SafetyChain, GivesNoForceBeforeHoming)
{
  DeviceLimits device = arm();
  device.needsHoming = true;
  Bench bench(device);
  bench.status.homed = false;
  bench.orders.armed = true;
  for (int i = 0; i < 200; ++i)
  {
    const Sample sample = bench.at(5.0_mm);
    ASSERT_EQ(sample.force, Vector3d::Zero());
    ASSERT_EQ(sample.state, DeviceState::NeedsHoming);
    ASSERT_TRUE(has(sample, Flag::NotHomed));
  }
  bench.status.homed = true;
  EXPECT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
  EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
}

// before it, places mean nothing; with it, all of them change at once
TEST(SafetyChain, HomingMovesEveryPlaceWithoutAFault)
{
  DeviceLimits device = arm();
  device.needsHoming = true;
  Bench bench(device);
  bench.orders.armed = true;
  for (int round = 0; round < 2; ++round) // the second as after a loss of its zero
  {
    bench.status.homed = false;
    for (int i = 0; i < 20; ++i)
    {
      const Sample sample = bench.at(i % 2 == 0 ? -5.0_mm : -69.0_mm);
      ASSERT_EQ(sample.state, DeviceState::NeedsHoming);
      ASSERT_TRUE(!has(sample, Flag::Jump) || i == 0);
    }
    bench.status.homed = true;
    const Sample homed = bench.at(-5.0_mm);
    EXPECT_FALSE(has(homed, Flag::Jump));
    EXPECT_EQ(homed.pose.apex.z(), 5.0_mm);
    EXPECT_EQ(homed.force, Vector3d::Zero());
    EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
    bench.position = -5.0_mm;
    bench.activate();
  }
}

TEST(SafetyChain, AStopOfTheBoardIsLatchedAsAnyOther)
{
  Bench bench;
  bench.activate();
  ASSERT_GT(bench.press(5.0_mm).force.z(), 0.0);
  bench.status.stopped = true;
  const Sample stopped = bench.at(5.0_mm);
  EXPECT_EQ(stopped.force, Vector3d::Zero());
  EXPECT_TRUE(has(stopped, Flag::EmergencyStop));
  for (const bool armed : { true, false, true }) // arming a stopped board arms nothing
  {
    bench.orders.armed = armed;
    EXPECT_EQ(bench.at(5.0_mm).state, DeviceState::Ready);
  }
  bench.status.stopped = false;
  for (int i = 0; i < 1000; ++i)
  {
    ASSERT_EQ(bench.at(5.0_mm).state, DeviceState::Ready);
  }
  bench.orders.armed = false;
  (void)bench.at(5.0_mm);
  bench.orders.armed = true;
  EXPECT_EQ(bench.at(5.0_mm).state, DeviceState::SoftStart);
}

TEST(SafetyChain, DeadManNeedsTheButton)
{
  Bench bench(arm(), { .deadMan = true });
  bench.orders.armed = true;
  for (int i = 0; i < 200; ++i)
  {
    ASSERT_EQ(bench.at(5.0_mm).state, DeviceState::Ready);
  }
  bench.status.buttons = 1;
  bench.position = -5.0_mm;
  for (int i = 0; i < 100; ++i)
  {
    (void)bench.at(5.0_mm - i * 0.1_mm);
  }
  EXPECT_EQ(bench.chain.state(), DeviceState::Active);
  ASSERT_GT(bench.press(5.0_mm).force.z(), 0.0);
  bench.status.buttons = 0;
  for (int i = 0; i < 110; ++i)
  {
    (void)bench.at(5.0_mm);
  }
  EXPECT_EQ(bench.force, Vector3d::Zero());
}

TEST(SafetyChain, DisarmingLetsTheForceFade)
{
  Bench bench;
  bench.activate();
  double last = bench.press(5.0_mm).force.z();
  bench.orders.armed = false;
  for (int i = 0; i < 101; ++i)
  {
    const double now = bench.at(5.0_mm).force.z();
    ASSERT_LE(now, last);
    ASSERT_LE(last - now, kSoftSlew);
    last = now;
  }
  EXPECT_EQ(last, 0.0);
  EXPECT_EQ(bench.chain.state(), DeviceState::Ready);
}

// the fraction of the largest force that a start has reached is no fraction of the force
TEST(SafetyChain, DisarmingDuringASoftStartLetsTheForceFade)
{
  for (const int ticks : { 50, 200, 400 })
  {
    Bench bench;
    (void)bench.press(5.0_mm);
    bench.orders.armed = true;
    (void)bench.at(5.0_mm);
    for (int i = 1; i <= ticks; ++i)
    {
      bench.position = 5.0_mm + i * 0.01_mm;
      (void)bench.at(bench.position);
    }
    ASSERT_EQ(bench.chain.state(), DeviceState::SoftStart);
    double last = bench.force.z();
    ASSERT_GT(last, 0.1);
    bench.orders.armed = false;
    for (int i = 0; i < 101; ++i)
    {
      const double now = bench.at(bench.position).force.z();
      ASSERT_LE(now, last);
      ASSERT_LE(last - now, kSoftSlew) << i;
      last = now;
    }
    EXPECT_EQ(last, 0.0);
  }
}

} // namespace
} // namespace palp
