#include "haptics/devices/bus_device.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <atomic>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;

// what a made up device was told and what it does, kept beyond the life of its drivers
struct Fake
{
  std::atomic<int> opened = 0;
  std::atomic<int> losses = 0;
  std::atomic<bool> pulled = false;
  std::atomic<bool> homed = true;
  std::atomic<bool> stopped = false;
  std::atomic<double> heat = 0.0;
  std::atomic<int> failing = 0;   // transfers that do not reach it, from now on
  std::atomic<double> last = 0.0; // size of the last force that reached it [N]
  std::atomic<double> left = 0.0; // the same, when its driver was closed
  std::vector<Vector3d> forces;   // read after the thread has ended
  std::vector<double> times;      // as told [s]; the same
  std::vector<std::chrono::steady_clock::time_point> ends; // of ticks; the same
  std::atomic<bool> blocks = false;                        // its bus: no transfer comes to an end
  std::atomic<bool> blocked = false;
};

class FakeDriver final : public Driver
{
public:
  explicit FakeDriver(Fake& fake)
    : fake_(fake)
  {
    if (fake.pulled)
    {
      throw Error(ErrorCode::NoDevice, "fake: unplugged");
    }
    ++fake.opened;
  }

  ~FakeDriver() override
  {
    fake_.left = fake_.last.load();
  }

  FakeDriver(const FakeDriver&) = delete;
  FakeDriver& operator=(const FakeDriver&) = delete;

  DeviceLimits limits() const override
  {
    return {
      .model = "fake", .rendersForce = true, .needsHoming = true, .maxForce = 4.0, .damping = 1.0
    };
  }

  IoCode tick(const Wrench& wrench, double dt, DriverSample& sample) noexcept override
  {
    for (; fake_.blocks; fake_.blocked = true) // as a USB transfer may
    {
      std::this_thread::sleep_for(1ms);
    }
    if (fake_.pulled || fake_.failing > 0)
    {
      --fake_.failing;
      ++fake_.losses;
      return IoCode::Gone;
    }
    fake_.forces.push_back(wrench.force);
    fake_.times.push_back(dt);
    fake_.ends.push_back(std::chrono::steady_clock::now());
    fake_.last = wrench.force.norm();
    sample = { .position = Vector3d(1.0_mm, 2.0_mm, 3.0_mm + ++ticks_ * 1.0_um),
      .homed = fake_.homed,
      .stopped = fake_.stopped,
      .heat = fake_.heat };
    return IoCode::Ok;
  }

private:
  Fake& fake_;
  int ticks_ = 0;
};

BusDevice::Open opening(Fake& fake)
{
  return [&fake] { return std::make_unique<FakeDriver>(fake); };
}

// asks a device once a millisecond, as long as a machine under load may take
template <typename Condition>
void exchangeUntil(Device& device, const Vector3d& force, const Condition& condition)
{
  while (!condition(device.exchange(force, 1.0_ms)))
  {
    std::this_thread::sleep_for(1ms);
  }
}

TEST(BusDevice, StandsWhereItIsPlacedAndEndsWithZeroForce)
{
  Fake fake;
  {
    DevicePlacement placement;
    placement.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; // a quarter turn about z
    placement.origin = Vector3d(0.1, 0, 0);
    BusDevice device(opening(fake), placement);
    exchangeUntil(device, Vector3d(0, 1, 0),
      [&](const auto& pose)
      {
        EXPECT_TRUE(pose->apex.head(2).isApprox(Eigen::Vector2d(0.1 - 2.0_mm, 1.0_mm)));
        return fake.last == 1.0;
      });
  }
  ASSERT_GE(fake.forces.size(), 10U);
  EXPECT_TRUE(std::ranges::any_of(
    fake.forces, [](const Vector3d& force) { return force.isApprox(Vector3d(1, 0, 0)); }));
  EXPECT_TRUE(std::all_of(fake.forces.end() - 10, fake.forces.end(),
    [](const Vector3d& force) { return force.isZero(0.0); }));
}

// while the watching thread is held up by the bus, a servo gets the pose that it knows, and its age
TEST(BusDevice, TellsTheAgeOfAPoseThatTheBusHoldsUp)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  const double known = device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z();
  fake.blocks = true;
  while (!fake.blocked)
  {
    std::this_thread::sleep_for(1ms);
  }
  double age = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z(), known);
    EXPECT_GE(device.status().age, age);
    age = device.status().age;
  }
  fake.blocks = false;
  exchangeUntil(device, Vector3d::Zero(), [&](const auto& pose) { return pose->apex.z() > known; });
}

// by the clock of the one that receives: from the exchange that gave a pose to that of its force
TEST(BusDevice, MeasuresHowLateAForceIs)
{
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;
  Fake fake;
  BusDevice device(opening(fake), {});
  for (const auto pause : { 2ms, 10ms })
  {
    Seconds least(0.0);
    Seconds most(0.0);
    double sent = 0.0;
    do // anew where the machine held this up until the watching thread ended the force
    {
      const auto begin = Clock::now();
      (void)device.exchange(Vector3d::Zero(), 1.0_ms);
      const auto told = Clock::now();
      std::this_thread::sleep_for(pause);
      least = Clock::now() - told;
      device.answer(Vector3d(0, 0, 2));
      sent = fake.last; // at once, not with the next pose
      most = Clock::now() - begin;
    } while (most >= 20ms);
    EXPECT_EQ(sent, 2.0);
    EXPECT_GE(device.status().delay, least.count());
    EXPECT_LE(device.status().delay, most.count());
  }
  const double delay = device.status().delay;
  (void)device.exchange(Vector3d(0, 0, 2), 1.0_ms);
  EXPECT_EQ(device.status().delay, delay); // that pose had been answered
}

// a servo that starts late, at first or because the device was put elsewhere, is no delay
TEST(BusDevice, APoseFromBeforeItsServoIsNotWaitedFor)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  for (int start = 0; start < 2; ++start)
  {
    std::this_thread::sleep_for(5ms);
    (void)device.exchange(Vector3d::Zero(), 1.0_ms);
    EXPECT_EQ(device.status().delay, 0.0);
    EXPECT_TRUE(device.place({}));
  }
}

// motors take up heat in it, and a tool that goes at a rate its way
TEST(BusDevice, TellsEachTimeOnceWhicheverThreadTicks)
{
  const auto begin = std::chrono::steady_clock::now();
  Fake fake;
  {
    BusDevice device(opening(fake), {});
    for (int round = 0; round < 10; ++round)
    {
      exchangeUntil(device, Vector3d(0, 0, 1), [&](const auto&) { return fake.last == 1.0; });
      while (fake.last != 0.0) // until the watching thread has ended it
      {
        std::this_thread::sleep_for(1ms);
      }
    }
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  const std::chrono::duration<double> atLeast = fake.ends.end()[-2] - fake.ends.front();
  const double told = std::accumulate(fake.times.begin(), fake.times.end(), 0.0);
  EXPECT_LE(told, passed.count());
  EXPECT_GE(told, atLeast.count());
}

TEST(BusDevice, NoPoseIsYoungerThanNow)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  double youngest = 0.0;
  for (double newest = 0.0; newest < 3.5_mm;) // 500 exchanges, each asked for all the time
  {
    newest = device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z();
    youngest = std::min(youngest, device.status().age);
  }
  EXPECT_EQ(youngest, 0.0);
}

TEST(BusDevice, PassesOnThatItsDeviceIsStoppedAndHowWarmItsMotorsAre)
{
  Fake fake;
  fake.stopped = true;
  fake.heat = 0.75;
  BusDevice device(opening(fake), {});
  EXPECT_TRUE(device.exchange(Vector3d::Zero(), 1.0_ms));
  EXPECT_TRUE(device.status().stopped);
  EXPECT_EQ(device.status().heat, 0.75);
}

// some errors pass: a device that is still there would hold the last force for ever
TEST(BusDevice, ATransferThatFailsLeavesNoForceInTheMotors)
{
  for (const int failing : { 1, 4 })
  {
    Fake fake;
    BusDevice device(opening(fake), {});
    exchangeUntil(device, Vector3d(0, 0, 3), [&](const auto&) { return fake.last == 3.0; });
    fake.failing = failing;
    while (fake.opened < 2)
    {
      std::this_thread::sleep_for(1ms);
    }
    EXPECT_EQ(fake.left, 0.0);
  }
}

TEST(BusDevice, AForceThatIsNotRenewedEnds)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  exchangeUntil(device, Vector3d(0, 0, 1), [&](const auto&) { return fake.last == 1.0; });
  while (fake.last != 0.0) // the servo has stalled
  {
    std::this_thread::sleep_for(1ms);
  }
}

TEST(BusDevice, ComesBackWithANewDriverWhenItIsPluggedInAgain)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  for (int round = 1; round <= 2; ++round)
  {
    EXPECT_EQ(fake.opened, round);
    fake.pulled = true;
    exchangeUntil(device, Vector3d(0, 0, 1), [](const auto& pose) { return !pose; });
    fake.homed = false; // its power was off
    fake.pulled = false;
    exchangeUntil(device, Vector3d::Zero(), [](const auto& pose) { return pose.has_value(); });
    EXPECT_FALSE(device.status().homed);
  }
}

// a loop that stalls must not take a device that was replugged for one that was there all the time
TEST(BusDevice, TellsALossThatTheServoSlept)
{
  Fake fake;
  BusDevice device(opening(fake), {});
  ASSERT_TRUE(device.exchange(Vector3d::Zero(), 1.0_ms));
  fake.pulled = true;
  while (fake.losses == 0)
  {
    std::this_thread::sleep_for(1ms);
  }
  fake.pulled = false;
  while (fake.opened < 2)
  {
    std::this_thread::sleep_for(1ms);
  }
  for (int tick = 0; tick < 2; ++tick) // a pose of the new driver is there
  {
    fake.last = -1.0;
    while (fake.last < 0.0)
    {
      std::this_thread::sleep_for(1ms);
    }
  }
  EXPECT_FALSE(device.exchange(Vector3d::Zero(), 1.0_ms));
}

TEST(BusDevice, ThatNeverAnswersIsRefusedInOneSentence)
{
  Fake fake;
  const auto open = [&fake]
  {
    auto driver = std::make_unique<FakeDriver>(fake);
    fake.pulled = true; // between opening and the first pose
    return driver;
  };
  try
  {
    const BusDevice device(open, {});
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::NoDevice);
    EXPECT_NE(std::string(error.what()).find("does not answer"), std::string::npos);
  }
}

} // namespace
} // namespace palp
