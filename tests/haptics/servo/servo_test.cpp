#include "haptics/servo/servo.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;

// holds its depth, keeps the forces it is sent, goes away when told to
class Probe final : public Device
{
public:
  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "probe", .rendersForce = rendersForce, .maxForce = 7.9, .damping = 1.0 };
  }

  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench& wrench, double dt) noexcept override
  {
    last = wrench.force;
    elapsed += dt;
    ++calls;
    if (stall > 0ms && calls == 5)
    {
      std::this_thread::sleep_for(stall);
    }
    if (gone.load())
    {
      return std::nullopt;
    }
    return ToolPose{ .apex = { 0.0, 0.0, -2.0_mm },
      .axis = -Eigen::Vector3d::UnitZ(),
      .velocity = Eigen::Vector3d::Zero() };
  }

  [[nodiscard]] DeviceStatus status() const noexcept override
  {
    return { .buttons = button ? 1U : 0U };
  }

  bool rendersForce = false;
  std::atomic<bool> gone = false;
  std::atomic<bool> button = false;
  std::chrono::milliseconds stall = 0ms;
  Eigen::Vector3d last = Eigen::Vector3d::Zero(); // read after the servo has ended
  double elapsed = 0.0;
  std::atomic<int> calls = 0;
};

// waits as a bus does, and counts what goes over it
class BusProbe final : public Device
{
public:
  explicit BusProbe(std::chrono::microseconds bus)
    : bus_(bus)
  {
    starts.reserve(1'000'000);
  }

  [[nodiscard]] DeviceLimits limits() const override
  {
    return { .model = "bus", .rendersForce = true, .maxForce = 7.9, .damping = 1.0 };
  }

  [[nodiscard]] std::optional<ToolPose> exchange(const Wrench&, double) noexcept override
  {
    starts.push_back(std::chrono::steady_clock::now());
    std::this_thread::sleep_for(bus_);
    ++exchanges;
    return ToolPose{ .apex = { 0.0, 0.0, 2.0_mm } };
  }

  void answer(const Wrench&) noexcept override
  {
    answers += exchanges > answers ? 1 : 1000; // one after each exchange at most
  }

  [[nodiscard]] double busTime() const noexcept override
  {
    return std::chrono::duration<double>(bus_).count();
  }

  [[nodiscard]] double medianPeriod() const
  {
    std::vector<double> periods;
    for (std::size_t i = 1; i < starts.size(); ++i)
    {
      periods.push_back(std::chrono::duration<double>(starts[i] - starts[i - 1]).count());
    }
    std::ranges::nth_element(periods, periods.begin() + static_cast<long>(periods.size() / 2));
    return periods[periods.size() / 2];
  }

  std::vector<std::chrono::steady_clock::time_point> starts; // read after the servo has ended
  std::atomic<int> exchanges = 0;
  std::atomic<int> answers = 0;

private:
  std::chrono::microseconds bus_;
};

Scene scene()
{
  Scene world;
  world.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 4)));
  return world;
}

constexpr ServoOptions kPlain{ .realtime = false };

// whether a sample comes to say so in time
template <typename Condition>
bool becomes(Servo& servo, Condition condition, std::chrono::milliseconds longest)
{
  const auto end = std::chrono::steady_clock::now() + longest;
  while (!condition(servo.newest()) && std::chrono::steady_clock::now() < end)
  {
    std::this_thread::sleep_for(1ms);
  }
  return condition(servo.newest());
}

template <typename Condition>
Sample waitFor(Servo& servo, Condition condition)
{
  EXPECT_TRUE(becomes(servo, condition, 60s));
  return servo.newest();
}

// a machine that does much else loses ticks, and then the force has to be asked for again
void waitForForce(Servo& servo, Scene world)
{
  const auto isActive = [](const Sample& sample) { return sample.state == DeviceState::Active; };
  for (int attempt = 0; attempt < 200; ++attempt)
  {
    if (becomes(servo, isActive, 1s))
    {
      return;
    }
    world.armed = false;
    servo.setScene(world);
    std::this_thread::sleep_for(100ms);
    world.armed = true;
    servo.setScene(world);
  }
  ADD_FAILURE() << "no force";
}

bool has(const Sample& sample, Flag flag)
{
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

TEST(Servo, PressesAndEndsWithZeroForce)
{
  Probe probe;
  {
    Servo servo(probe, scene(), kPlain);
    waitFor(servo, [](const Sample& sample) { return sample.force.z() > 0.1; });
  }
  EXPECT_EQ(probe.last, Eigen::Vector3d::Zero());
}

TEST(Servo, AHandFeelsNothingUntilTheSceneIsArmed)
{
  Probe probe;
  probe.rendersForce = true;
  Scene world = scene();
  Servo servo(probe, world, kPlain);
  const Sample off = waitFor(servo, [](const Sample& sample) { return sample.time > 0.05; });
  EXPECT_EQ(off.force, Eigen::Vector3d::Zero());
  EXPECT_EQ(off.state, DeviceState::Ready);
  EXPECT_GT(off.response.force, 0.1);
  world.armed = true;
  servo.setScene(world);
  waitFor(servo, [](const Sample& sample) { return sample.state == DeviceState::SoftStart; });
}

TEST(Servo, TheForceOfAMainThreadThatHangsFadesAndThenStops)
{
  Probe probe;
  probe.rendersForce = true;
  Scene world = scene();
  world.armed = true;
  Servo servo(probe, world, kPlain);
  waitForForce(servo, world);
  bool faded = false;
  bool stopped = false;
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!stopped && std::chrono::steady_clock::now() < end) // whoever drains does not look
  {
    std::this_thread::sleep_for(1ms);
    servo.history().drain(
      [&](const Sample& sample)
      {
        stopped = stopped || has(sample, Flag::EmergencyStop);
        faded =
          faded || (has(sample, Flag::WatchdogExpired) && !stopped && sample.force.isZero(0.0));
        EXPECT_TRUE(!stopped || sample.force.isZero(0.0));
      });
  }
  EXPECT_TRUE(stopped);
  EXPECT_TRUE(faded);
}

TEST(Servo, AStopFromOutsideWorksWhileTheMainThreadHangs)
{
  Probe probe;
  probe.rendersForce = true;
  Scene world = scene();
  world.armed = true;
  std::atomic<bool> stop = false;
  Servo servo(probe, world, { .realtime = false, .stop = &stop });
  waitForForce(servo, world);
  stop = true; // a signal
  const int calls = probe.calls;
  waitFor(servo, [&](const Sample&) { return probe.calls >= calls + 5; });
  EXPECT_TRUE(has(servo.newest(), Flag::EmergencyStop));
}

TEST(Servo, DeadManNeedsTheButton)
{
  Probe probe;
  probe.rendersForce = true;
  Scene world = scene();
  world.armed = true;
  Servo servo(probe, world, { .realtime = false, .deadMan = true });
  waitFor(servo, [](const Sample& sample) { return sample.time > 0.05; });
  EXPECT_EQ(servo.newest().state, DeviceState::Ready);
  probe.button = true;
  waitForForce(servo, world);
}

TEST(Servo, TakesANewScene)
{
  Probe probe;
  Servo servo(probe, Scene{}, kPlain);
  waitFor(servo, [](const Sample& sample) { return sample.time > 0.0; });
  EXPECT_EQ(servo.newest().force, Eigen::Vector3d::Zero());
  servo.setScene(scene());
  waitFor(servo, [](const Sample& sample) { return sample.contact.touching(); });
  servo.setScene(Scene{});
  waitFor(servo, [](const Sample& sample) { return !sample.contact.touching(); });
}

TEST(Servo, EmergencyStopHoldsUntilReleased)
{
  Probe probe;
  Servo servo(probe, scene(), kPlain);
  waitFor(servo, [](const Sample& sample) { return sample.force.z() > 0.1; });
  servo.setEmergencyStop(true);
  const Sample stopped =
    waitFor(servo, [](const Sample& sample) { return has(sample, Flag::EmergencyStop); });
  EXPECT_EQ(stopped.force, Eigen::Vector3d::Zero());
  servo.setEmergencyStop(false);
  waitFor(servo, [](const Sample& sample) { return sample.force.z() > 0.1; });
}

TEST(Servo, ALostDeviceGetsNoForce)
{
  Probe probe;
  Servo servo(probe, scene(), kPlain);
  waitFor(servo, [](const Sample& sample) { return sample.contact.touching(); });
  probe.gone = true;
  const Sample lost =
    waitFor(servo, [](const Sample& sample) { return has(sample, Flag::DeviceLost); });
  EXPECT_EQ(lost.force, Eigen::Vector3d::Zero());
  EXPECT_EQ(lost.pose.apex.z(), -2.0_mm); // frozen where it was
}

// every period since the start is either a tick or counted as skipped
TEST(Servo, SkipsAndCountsWhatItMissed)
{
  Probe probe;
  probe.stall = 30ms;
  std::uint64_t periods = 0;
  double time = 0.0;
  {
    Servo servo(probe, scene(), kPlain);
    const Sample last = waitFor(servo, [](const Sample& sample) { return sample.time > 0.1; });
    time = last.time;
    waitFor(servo, [&](const Sample& sample) { return sample.time > time; }); // it has been counted
    periods = servo.timing().ticks + servo.timing().skipped;
    EXPECT_GE(servo.timing().skipped, 29U);
    const std::uint64_t ticks = servo.timing().ticks; // first: the servo goes on
    EXPECT_GE(servo.timing().lateness.count(), ticks);
    servo.history().drain(
      [&, previous = -1.0](const Sample& sample) mutable
      {
        EXPECT_GT(sample.time, previous);
        previous = sample.time;
      });
  }
  EXPECT_GE(static_cast<double>(periods), time / 1.0_ms - 1.0);
}

TEST(Servo, AForceThatHasTimeGoesOutBeforeTheNextPose)
{
  BusProbe probe(100us);
  {
    Servo servo(probe, scene(), kPlain);
    waitFor(servo, [&](const Sample&) { return probe.exchanges > 300; });
  }
  EXPECT_GE(probe.answers, probe.exchanges / 2); // a machine under load is late at times
  EXPECT_LE(probe.answers, probe.exchanges);
}

TEST(Servo, ASlowBusSetsThePaceSoThatNoForceWaits)
{
  BusProbe probe(2ms);
  {
    Servo servo(probe, scene(), kPlain);
    waitFor(servo, [&](const Sample&) { return probe.exchanges > 300; });
    EXPECT_LE(servo.timing().skipped, 100U); // what the bus takes is no tick lost
  }
  EXPECT_EQ(probe.answers, 0);
  EXPECT_GE(probe.medianPeriod(), 2.0_ms);
  EXPECT_LE(probe.medianPeriod(), 2.6_ms); // on a grid of 1 ms it were 3
}

TEST(Servo, TurnsAsOftenAsItIsAsked)
{
  Probe probe;
  Servo servo(probe, scene(), { .period = 250us, .realtime = false });
  waitFor(servo, [](const Sample& sample) { return sample.time > 0.5; });
  const auto ticks = servo.timing().ticks + servo.timing().skipped;
  EXPECT_GE(ticks, 1999U);
  EXPECT_THROW(Servo(probe, scene(), { .period = 100us, .realtime = false }), Error);
}

TEST(Servo, SaysHowItIsScheduled)
{
  Probe probe;
  EXPECT_NE(Servo(probe, Scene{}).schedule().find("priority"), std::string::npos);
}

} // namespace
} // namespace palp
