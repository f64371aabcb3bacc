#include "tests/haptics/servo/safety_bench.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace test;

// whatever a device says: finite, bounded in size and rate
TEST(SafetyChain, TellsMotorsThatWillSoonGiveLess)
{
  Bench bench;
  EXPECT_FALSE(has(bench.at(0.0), Flag::MotorsWarm));
  bench.status.heat = 0.81;
  EXPECT_TRUE(has(bench.at(0.0), Flag::MotorsWarm));
  bench.status.heat = 0.79;
  EXPECT_FALSE(has(bench.at(0.0), Flag::MotorsWarm));
}

TEST(SafetyChain, BoundsEverythingThatAMillionWildTicksCanBring)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> fraction(0.0, 1.0);
  const auto anything = [&]
  {
    return fraction(random) < 0.5 ? (fraction(random) - 0.5) * 0.05
                                  : std::bit_cast<double>(random());
  };
  Bench bench;
  std::uint64_t bad = 0;
  for (int i = 0; i < 1'000'000; ++i)
  {
    const bool wild = fraction(random) < 0.02;
    ToolPose pose{ .apex = Vector3d(0, 0, -0.01 * std::sin(i * 0.003)) };
    if (wild)
    {
      pose.apex[i % 3] = anything();
      pose.velocity[(i + 1) % 3] = anything();
      pose.axis[(i + 2) % 3] = fraction(random) < 0.2 ? anything() : pose.axis[(i + 2) % 3];
    }
    bench.stiffness = wild ? anything() : 500.0;
    bench.scene.damping = wild ? anything() : 1.0;
    bench.scene.forceLimit = wild ? anything() : 4.0;
    bench.status.age = wild && fraction(random) < 0.1 ? anything() : 0.0;
    bench.orders.armed = i % 1000 > 2;
    bench.orders.stop = fraction(random) < 1e-4;
    const Vector3d before = bench.force;
    const bool gone = fraction(random) < 1e-4;
    const Sample sample = bench.tick(gone ? std::nullopt : std::optional(pose),
      wild && fraction(random) < 0.2 ? anything() : kTick);
    const bool grows = sample.force.norm() > before.norm();
    bad += !sample.force.allFinite() || !std::isfinite(sample.proxyDepth);
    bad += sample.force.norm() > 4.0 * (1.0 + 1e-12) && !wild;
    bad += sample.force.norm() > 7.9 * (1.0 + 1e-12);
    bad += grows && (sample.force - before).norm() > 4.0 * kSlew * (1.0 + 1e-9); // 4 ticks at most
  }
  EXPECT_EQ(bad, 0U);
}

TEST(SafetyChain, LateTickStartsTheForceAgain)
{
  for (int missed = 1; missed <= 20; ++missed)
  {
    Bench bench;
    bench.activate();
    const Vector3d before = bench.press(5.0_mm).force;
    const Sample sample = bench.at(5.5_mm, (missed + 1) * kTick);
    EXPECT_EQ(has(sample, Flag::Late), missed > 5) << missed;
    EXPECT_LE((sample.force - before).norm(), kSlew * (missed > 3 ? 4 : missed + 1)) << missed;
    if (missed > 5)
    {
      EXPECT_EQ(sample.state, DeviceState::SoftStart);
      Vector3d last = sample.force;
      for (int i = 0; i < 10; ++i)
      {
        (void)bench.at(5.5_mm);
        EXPECT_LE((bench.force - last).norm(), kSlew);
        last = bench.force;
      }
      EXPECT_EQ(last, Vector3d::Zero());
    }
  }
}

// a loop that stalls again before its force is whole cannot hold a hand, and says so
TEST(SafetyChain, LateTicksThatNeverLetTheForceBecomeWholeEndIt)
{
  for (const int apart : { 100, 700 }) // ticks between two stalls
  {
    Bench bench;
    bench.activate();
    (void)bench.press(5.0_mm);
    for (int stall = 1; stall <= 10; ++stall)
    {
      const Sample late = bench.at(5.0_mm, 21 * kTick);
      const bool ended = apart == 100 && stall > 5;
      ASSERT_EQ(late.state, ended ? DeviceState::Ready : DeviceState::SoftStart) << stall;
      for (int i = 0; i < apart; ++i)
      {
        ASSERT_EQ(has(bench.at(5.0_mm), Flag::Late), ended);
      }
    }
  }
}

TEST(SafetyChain, SilenceLetsTheForceFadeBetweenThreeAndTwentyMilliseconds)
{
  Bench bench;
  bench.activate();
  const double full = bench.press(5.0_mm).force.z();
  for (int age = 0; age <= 30; ++age)
  {
    bench.status.age = age * kTick;
    const Sample sample = bench.at(5.0_mm);
    const double left = std::clamp((20.0 - age) / 17.0, 0.0, 1.0);
    EXPECT_NEAR(sample.force.z(), full * left, 1e-9) << age;
    EXPECT_EQ(has(sample, Flag::Stale), age >= 20) << age;
  }
  bench.status.age = 0.0;
  EXPECT_EQ(bench.at(5.0_mm).force, Vector3d::Zero()); // waits to be armed again
  bench.orders.armed = false;
  (void)bench.at(5.0_mm);
  bench.orders.armed = true;
  (void)bench.at(5.0_mm);
  EXPECT_EQ(bench.chain.state(), DeviceState::SoftStart);
}

TEST(SafetyChain, AShortSilenceEndsWithoutAStep)
{
  Bench bench;
  bench.stiffness = 1400.0;
  bench.activate();
  Vector3d before = bench.press(2.5_mm).force;
  for (const double age : { 5.0_ms, 12.0_ms, 19.0_ms, 0.0_ms, 0.0_ms })
  {
    bench.status.age = age;
    const Vector3d force = bench.at(2.5_mm).force;
    EXPECT_LE(force.norm() - before.norm(), kSlew);
    before = force;
  }
}

// the last pose is told again and again while a device is silent; the next one is as far as a hand
// went meanwhile
TEST(SafetyChain, AHandThatMovesDuringASilenceHasNotJumped)
{
  for (const double speed : { 0.6, 1.0, 1.9 })
  {
    for (int silent = 1; silent < 20; ++silent)
    {
      Bench bench;
      bench.position = -50.0_mm;
      bench.activate();
      for (int age = 1; age <= silent; ++age)
      {
        bench.status.age = age * kTick;
        EXPECT_FALSE(has(bench.at(bench.position), Flag::Jump));
      }
      bench.status.age = 0.0;
      const Sample back = bench.at(bench.position + speed * (silent + 1) * kTick);
      ASSERT_FALSE(has(back, Flag::Jump)) << speed << " m/s for " << silent << " ms";
      EXPECT_EQ(back.state, DeviceState::Active);
    }
  }
}

TEST(SafetyChain, ASilenceExcusesNoMoreThanAHandCanMoveInIt)
{
  Bench bench;
  bench.activate();
  for (int age = 1; age <= 8; ++age)
  {
    bench.status.age = age * kTick;
    (void)bench.at(bench.position);
  }
  bench.status.age = 0.0;
  EXPECT_TRUE(has(bench.at(bench.position - 2.1 * 9 * kTick), Flag::Jump)); // [m], at 2.1 m/s
}

TEST(SafetyChain, JumpIsHeldThenAFaultThatFades)
{
  Bench bench;
  bench.activate();
  const double before = bench.press(2.0_mm).force.z();
  for (int i = 0; i < 3; ++i)
  {
    const Sample sample = bench.at(52.0_mm);
    EXPECT_NEAR(sample.force.z(), before, 1e-12);
    EXPECT_NEAR(sample.contact.depth, 2.0_mm, 1e-15);
  }
  for (int i = 0; i < 500; ++i)
  {
    EXPECT_LE(bench.at(52.0_mm).force.norm(), before + kSlew);
  }
  const Sample after = bench.at(52.0_mm);
  EXPECT_TRUE(has(after, Flag::Jump));
  EXPECT_EQ(after.force, Vector3d::Zero());
  EXPECT_EQ(after.state, DeviceState::Ready);
}

TEST(SafetyChain, AGlitchOfOnePoseIsForgotten)
{
  Bench bench;
  bench.activate();
  const Vector3d before = bench.press(2.0_mm).force;
  (void)bench.at(52.0_mm);
  const Sample sample = bench.at(2.0_mm);
  EXPECT_EQ(sample.force, before);
  EXPECT_EQ(sample.flags, 0U);
}

class NotFinite : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(SafetyChain, NotFinite, ::testing::Range(0, 6));

TEST_P(NotFinite, EndsTheForceInTheSameTickAndStays)
{
  Bench bench;
  bench.activate();
  ASSERT_GT(bench.press(5.0_mm).force.z(), 0.0);
  ToolPose pose{ .apex = Vector3d(0, 0, -5.0_mm) };
  const double stiffness = bench.stiffness;
  const auto spoil = std::array<std::function<void()>, 6>{ [&] { pose.apex.x() = kNaN; },
    [&] { pose.velocity.y() = kInf; }, [&] { pose.axis.z() = kNaN; },
    [&] { bench.stiffness = kNaN; }, [&] { bench.scene.damping = kNaN; },
    [&] { bench.scene.forceLimit = kNaN; } };
  spoil[static_cast<std::size_t>(GetParam())]();
  const Sample sample = bench.tick(pose);
  EXPECT_EQ(sample.force, Vector3d::Zero());
  EXPECT_TRUE(has(sample, Flag::NotFinite));

  bench.stiffness = stiffness;
  bench.scene = Scene{};
  EXPECT_EQ(bench.at(5.0_mm).force, Vector3d::Zero());
  EXPECT_TRUE(has(bench.at(5.0_mm), Flag::NotFinite));
}

TEST(SafetyChain, AMainThreadThatIsSilentLosesTheForceAndGetsItBackSoftly)
{
  Bench bench;
  bench.activate();
  const double full = bench.press(5.0_mm).force.z();
  for (int silent = 0; silent <= 1000; ++silent)
  {
    bench.orders.heartbeatAge = silent * kTick;
    const Sample sample = bench.at(5.0_mm);
    const double left = std::clamp((300.0 - silent) / 100.0, 0.0, 1.0);
    ASSERT_NEAR(sample.force.z(), full * left, 1e-9) << silent;
    ASSERT_EQ(has(sample, Flag::WatchdogExpired), silent >= 200) << silent;
  }
  bench.orders.heartbeatAge = 0.0;
  Vector3d before = Vector3d::Zero();
  for (int i = 0; i < 600; ++i)
  {
    (void)bench.at(5.0_mm);
    ASSERT_LE((bench.force - before).norm(), kSoftSlew * (1.0 + 1e-9));
    before = bench.force;
  }
  EXPECT_EQ(
    bench.chain.state(), DeviceState::Active); // no fault: nothing was wrong with the device
}

TEST(SafetyChain, AMainThreadThatIsDeadIsAnEmergencyStop)
{
  Bench bench;
  bench.activate();
  for (const double heartbeatAge : { 2.1, kNaN })
  {
    bench.orders = { .armed = true, .heartbeatAge = heartbeatAge };
    EXPECT_TRUE(has(bench.at(-5.0_mm), Flag::EmergencyStop));
    bench.orders.heartbeatAge = 0.0;
    EXPECT_EQ(bench.at(-5.0_mm).state, DeviceState::Ready); // latched
    bench.orders.armed = false;
    (void)bench.at(-5.0_mm);
    bench.activate();
  }
}

} // namespace
} // namespace palp
