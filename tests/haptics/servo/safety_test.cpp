#include "haptics/servo/safety.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kTick = 1.0_ms;
constexpr double kSlew = 0.5;      // [N] in a tick
constexpr double kSoftSlew = 0.05; // [N] in a tick

bool has(const Sample& sample, Flag flag)
{
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

DeviceLimits arm()
{
  return { .model = "arm", .rendersForce = true, .maxForce = 7.9, .damping = 2.0 };
}

// the chain over the plane z = 0 of a given stiffness, pressed along -z
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

  // moves at a hand's speed, so that no step is implausible
  Sample press(double depth)
  {
    Sample sample;
    for (; std::abs(depth - place) > 0.1_mm; place += std::copysign(0.1_mm, depth - place))
    {
      sample = at(place);
    }
    place = depth;
    return at(depth);
  }

  void activate()
  {
    orders.armed = true;
    for (int i = 0; i < 100; ++i)
    {
      (void)at(place);
    }
    ASSERT_EQ(chain.state(), DeviceState::Active);
  }

  SafetyChain chain;
  Scene scene;
  DeviceStatus status;
  SafetyOrders orders;
  double stiffness = 500.0;
  double place = -5.0_mm;
  Vector3d force = Vector3d::Zero();
};

TEST(SafetyChain, IsSilentUntilItIsArmed)
{
  Bench bench;
  const Sample sample = bench.press(5.0_mm);
  EXPECT_EQ(sample.force, Vector3d::Zero());
  EXPECT_NEAR(sample.response.force, 2.5, 1e-12); // what it would be is known all the same
  EXPECT_EQ(sample.state, DeviceState::Ready);
  EXPECT_TRUE(has(sample, Flag::Disarmed));
}

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

// so the later stages cannot hide what they give from the ledger
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

// whatever a device says: finite, bounded in size and rate
TEST(SafetyChain, BoundsEverythingThatAMillionWildTicksCanBring)
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto anything = [&]
  { return share(random) < 0.5 ? (share(random) - 0.5) * 0.05 : std::bit_cast<double>(random()); };
  Bench bench;
  std::uint64_t bad = 0;
  for (int i = 0; i < 1'000'000; ++i)
  {
    const bool wild = share(random) < 0.02;
    ToolPose pose{ .apex = Vector3d(0, 0, -0.01 * std::sin(i * 0.003)) };
    if (wild)
    {
      pose.apex[i % 3] = anything();
      pose.velocity[(i + 1) % 3] = anything();
      pose.axis[(i + 2) % 3] = share(random) < 0.2 ? anything() : pose.axis[(i + 2) % 3];
    }
    bench.stiffness = wild ? anything() : 500.0;
    bench.scene.damping = wild ? anything() : 1.0;
    bench.scene.forceLimit = wild ? anything() : 4.0;
    bench.status.age = wild && share(random) < 0.1 ? anything() : 0.0;
    bench.orders.armed = i % 1000 > 2;
    bench.orders.stop = share(random) < 1e-4;
    const Vector3d before = bench.force;
    const bool gone = share(random) < 1e-4;
    const Sample sample = bench.tick(
      gone ? std::nullopt : std::optional(pose), wild && share(random) < 0.2 ? anything() : kTick);
    const bool grows = sample.force.norm() > before.norm();
    bad += !sample.force.allFinite() || !std::isfinite(sample.proxyDepth);
    bad += sample.force.norm() > 4.0 * (1.0 + 1e-12) && !wild;
    bad += sample.force.norm() > 7.9 * (1.0 + 1e-12);
    bad += grows && (sample.force - before).norm() > 4.0 * kSlew * (1.0 + 1e-9); // 4 ticks at most
  }
  EXPECT_EQ(bad, 0U);
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
  bench_.place = 5.0_mm;
  EXPECT_GT(bench_.press(6.0_mm).force.norm(), 0.0);
}

TEST(SafetyChain, AMainThreadThatIsSilentLosesTheForceAndGetsItBackSoftly)
{
  Bench bench;
  bench.activate();
  const double full = bench.press(5.0_mm).force.z();
  for (int silent = 0; silent <= 1000; ++silent)
  {
    bench.orders.silence = silent * kTick;
    const Sample sample = bench.at(5.0_mm);
    const double left = std::clamp((300.0 - silent) / 100.0, 0.0, 1.0);
    ASSERT_NEAR(sample.force.z(), full * left, 1e-9) << silent;
    ASSERT_EQ(has(sample, Flag::Unwatched), silent >= 200) << silent;
  }
  bench.orders.silence = 0.0;
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
  for (const double silence : { 2.1, kNaN })
  {
    bench.orders = { .armed = true, .silence = silence };
    EXPECT_TRUE(has(bench.at(-5.0_mm), Flag::EmergencyStop));
    bench.orders.silence = 0.0;
    EXPECT_EQ(bench.at(-5.0_mm).state, DeviceState::Ready); // latched
    bench.orders.armed = false;
    (void)bench.at(-5.0_mm);
    bench.activate();
  }
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

TEST(SafetyChain, DeadManNeedsTheButton)
{
  Bench bench(arm(), { .deadMan = true });
  bench.orders.armed = true;
  for (int i = 0; i < 200; ++i)
  {
    ASSERT_EQ(bench.at(5.0_mm).state, DeviceState::Ready);
  }
  bench.status.buttons = 1;
  bench.place = -5.0_mm;
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
    const Vector3d place(i * 0.5_mm, 0.0, 5.0_mm);
    const Sample sample =
      bench.tick(ToolPose{ .apex = place, .velocity = Vector3d(0.5, 0.0, 0.0) });
    ASSERT_EQ(has(sample, Flag::Workspace), i > 200) << i;
    ASSERT_LE((sample.force - before).norm(), kSlew * (1.0 + 1e-9)) << i;
    EXPECT_LE(sample.force.norm(), 2.0 + 1e-12);
    EXPECT_LE(sample.force.x(), 0.0);
    before = sample.force;
  }
  EXPECT_NEAR(before.x(), -2.0, 1e-12);
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
}

TEST(PeriodMonitor, IsTheNinetyNinthPercentile)
{
  PeriodMonitor monitor(1.0_ms);
  EXPECT_EQ(monitor.period(), 1.0_ms);
  for (int i = 0; i < 1000; ++i)
  {
    monitor.record(i % 50 == 0 ? 3.0_ms : 1.0_ms); // 2 % are slow
  }
  EXPECT_NEAR(monitor.period(), 3.0_ms, 0.11_ms);
  for (int i = 0; i < 1000; ++i)
  {
    monitor.record(i % 200 == 0 ? 3.0_ms : 1.0_ms); // half a percent
  }
  EXPECT_EQ(monitor.period(), 1.0_ms);
  monitor.record(1e9);
  EXPECT_EQ(monitor.period(), 1.0_ms);
}

} // namespace
} // namespace palp
