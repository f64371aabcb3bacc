#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/threaded_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/wooden_reference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <functional>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;
using Packet = std::vector<std::byte>;

Packet packetOf(Bytes bytes)
{
  return { bytes.begin(), bytes.end() };
}

// a device in memory: answers each packet as it is told, or not
struct Wire
{
  std::function<void(Bytes)> hear;
  std::deque<Packet> replies;
  std::vector<Packet> heard;
  bool gone = false;
  bool silent = false;
};

class MemoryTransport final : public SerialTransport
{
public:
  explicit MemoryTransport(Wire& wire)
    : wire_(wire)
  {
  }

  IoResult read(MutableBytes into, std::chrono::microseconds) noexcept override
  {
    if (wire_.gone)
    {
      return { IoCode::Gone, 0 };
    }
    if (wire_.silent || wire_.replies.empty())
    {
      return { IoCode::Timeout, 0 };
    }
    const Packet packet = wire_.replies.front();
    wire_.replies.pop_front();
    const std::size_t size = std::min(into.size(), packet.size());
    std::copy_n(packet.begin(), size, into.begin());
    return { IoCode::Ok, size };
  }

  IoCode write(Bytes bytes) noexcept override
  {
    if (wire_.gone)
    {
      return IoCode::Gone;
    }
    wire_.heard.push_back(packetOf(bytes));
    if (wire_.hear)
    {
      wire_.hear(bytes);
    }
    return IoCode::Ok;
  }

  bool request(std::uint8_t what, std::uint16_t value) noexcept override
  {
    if (what == 0 && value == 2) // SIO_TCIFLUSH of libftdi: what nobody has read
    {
      wire_.replies.clear();
    }
    return !wire_.gone;
  }

private:
  Wire& wire_;
};

bool isZeroCurrent(const Packet& packet) // with the report id
{
  return std::all_of(
    packet.begin() + 1, packet.begin() + 7, [](std::byte byte) { return byte == std::byte{ 0 }; });
}

// an arm in its workspace, calibrated by its button
Packet woodenReport(bool calibrate)
{
  Packet report(14);
  writeInt<std::int16_t>(report, 2, 764);
  writeInt<std::int16_t>(report, 4, 3667);
  writeInt<std::int16_t>(report, 12, calibrate ? 1 : 0);
  return report;
}

TEST(WoodenDriver, SendsNoCurrentBeforeItIsCalibrated)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  DriverSample sample;
  for (int i = 0; i < 100; ++i)
  {
    wire.replies.push_back(woodenReport(false));
    EXPECT_EQ(driver.tick(Vector3d(1, 1, 1), 1.0_ms, sample), IoCode::Ok);
    EXPECT_FALSE(sample.homed);
    EXPECT_TRUE(isZeroCurrent(wire.heard.back()));
    EXPECT_EQ(wire.heard.back().size(), 15U);
  }
  wire.replies.push_back(woodenReport(true));
  (void)driver.tick(Vector3d(1, 1, 1), 1.0_ms, sample);
  wire.replies.push_back(woodenReport(false));
  (void)driver.tick(Vector3d(1, 1, 1), 1.0_ms, sample); // the calibration goes out
  EXPECT_EQ(wire.heard.back()[7], std::byte{ 1 });
  EXPECT_EQ(readInt<std::int16_t>(wire.heard.back(), 13), 6000); // where the makers calibrate
  EXPECT_TRUE(sample.homed);
  wire.replies.push_back(woodenReport(false));
  (void)driver.tick(Vector3d(1, 1, 1), 1.0_ms, sample);
  EXPECT_FALSE(isZeroCurrent(wire.heard.back()));
}

TEST(WoodenDriver, IsNotHomedUntilTheBoardHasDoneAsItWasTold)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  DriverSample sample;
  const auto homedAfter = [&](bool calibrate)
  {
    wire.replies.push_back(woodenReport(calibrate));
    (void)driver.tick(Vector3d(1, 1, 1), 1.0_ms, sample);
    return sample.homed;
  };
  EXPECT_FALSE(homedAfter(true));
  EXPECT_FALSE(homedAfter(true)); // did not hear of it, or said so before: it is told again
  EXPECT_EQ(wire.heard.back()[7], std::byte{ 1 });
  EXPECT_TRUE(homedAfter(false));
  EXPECT_FALSE(homedAfter(true)); // the button once more
  EXPECT_TRUE(homedAfter(false));
}

TEST(WoodenDriver, TakesTheNewestOfWhatIsQueued)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  for (int i = 0; i < 20; ++i)
  {
    wire.replies.push_back(Packet(14));
  }
  wire.replies.push_back(woodenReport(false));
  DriverSample sample;
  EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  EXPECT_TRUE(sample.position.isApprox(test::woodenTool(test::WoodenCounts{ 0, 764, 3667 })));
  EXPECT_TRUE(wire.replies.empty());
}

TEST(Phd1Driver, SendsForceOnlyToABoardThatIsHomedAndNotStopped)
{
  Wire wire;
  Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
  Phd1State state;
  const auto tick = [&]
  {
    wire.replies.push_back(packetOf(encode(state)));
    DriverSample sample;
    EXPECT_EQ(driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample), IoCode::Ok);
    return *decodePhd1Command(Bytes(wire.heard.back()).subspan(1));
  };
  (void)tick();
  EXPECT_EQ(tick().force, Vector3d::Zero());
  state.homed = true;
  (void)tick();
  EXPECT_TRUE(tick().force.isApprox(Vector3d(0, 0, 1)));
  state.stopped = true;
  (void)tick();
  EXPECT_EQ(tick().force, Vector3d::Zero());
}

// a stopped board keeps its place, and must not be asked to go home
TEST(Phd1Driver, TellsThatItsBoardIsStoppedAndOrdersNothing)
{
  Wire wire;
  Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
  DriverSample sample;
  for (int i = 0; i < 2; ++i)
  {
    wire.replies.push_back(packetOf(encode(Phd1State{ .homed = true, .stopped = true })));
    EXPECT_EQ(driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample), IoCode::Ok);
  }
  EXPECT_TRUE(sample.homed);
  EXPECT_TRUE(sample.stopped);
  EXPECT_EQ(decodePhd1Command(Bytes(wire.heard.back()).subspan(1))->order, Phd1Order::Idle);
}

TEST(SpaceMouseDriver, StopsWhenItsReportOfRestWasLost)
{
  Wire wire;
  SpaceMouseDriver driver(std::make_unique<MemoryTransport>(wire));
  wire.replies.push_back({ std::byte{ 1 }, std::byte{ 0x5E }, std::byte{ 1 }, std::byte{ 0 },
    std::byte{ 0 }, std::byte{ 0 }, std::byte{ 0 } });
  DriverSample sample;
  for (int i = 0; i < 1000; ++i)
  {
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  }
  // full speed for a tenth of a second
  EXPECT_NEAR(sample.position.x(), 60.0_mm * 0.1, 60.0_mm * 2.0_ms);
}

// a Falcon that runs: answers each packet with counts of the middle of its reach
struct Falcon : Wire
{
  Falcon()
  {
    hear = [this](Bytes packet)
    {
      if (packet.size() != kFalconPacket)
      {
        return;
      }
      Packet reply{ std::byte{ 1 }, std::byte{ 0x60 } };
      Packet body = packetOf(encode(FalconCommand{ .torque = encoder })); // the same letters
      body[13] = static_cast<std::byte>('A' + (homed ? 0x70 : 0));
      reply.insert(reply.end(), body.begin(), body.end());
      replies.insert(replies.end(), late.begin(), late.end());
      late.clear();
      replies.push_back(reply);
    };
  }

  bool homed = false;
  std::deque<Packet> late; // replies that come with the next
  std::array<std::int16_t, 3> encoder{};
};

bool isZeroTorque(const Packet& packet)
{
  return std::all_of(packet.begin() + 1, packet.begin() + 13,
    [](std::byte byte) { return byte == std::byte{ 'A' }; });
}

TEST(FalconDriver, SendsNoTorqueBeforeItIsHomed)
{
  Falcon wire;
  FalconDriver driver(std::make_unique<MemoryTransport>(wire), {});
  DriverSample sample;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(driver.tick(Vector3d(1, 2, 3), 1.0_ms, sample), IoCode::Ok);
    EXPECT_FALSE(sample.homed);
    EXPECT_TRUE(isZeroTorque(wire.heard.back()));
    EXPECT_EQ(wire.heard.back()[13], std::byte{ 'B' }); // keeps asking for homing
  }
  wire.homed = true;
  (void)driver.tick(Vector3d(1, 2, 3), 1.0_ms, sample);
  EXPECT_TRUE(sample.homed);
  EXPECT_NEAR(sample.position.z(), 0.1346 - 0.125, 1e-4); // all encoders at zero
  (void)driver.tick(Vector3d(0, 0, -1), 1.0_ms, sample);
  EXPECT_FALSE(isZeroTorque(wire.heard.back()));
}

// one reply for each packet: one that came late would put all that follow a tick behind
TEST(FalconDriver, AReplyThatComesLateIsNotTakenForTheNext)
{
  for (const bool afterTheNextPacket : { false, true })
  {
    Falcon wire;
    wire.homed = true;
    FalconDriver driver(std::make_unique<MemoryTransport>(wire), {});
    DriverSample sample;
    wire.silent = true;
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout);
    wire.silent = false;
    wire.encoder = { 1000, 1000, 1000 };
    if (afterTheNextPacket)
    {
      wire.late.swap(wire.replies);
      (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
    }
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    EXPECT_NEAR(sample.position.z(), 0.1736 - 0.125, 1e-4) << afterTheNextPacket; // not 0.1346
  }
}

TEST(FalconDriver, AsksForFirmwareInOneSentence)
{
  Wire wire; // says nothing
  try
  {
    FalconDriver driver(std::make_unique<MemoryTransport>(wire), {});
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::NoDevice);
    EXPECT_NE(std::string(error.what()).find("falcon:FILE"), std::string::npos);
  }
}

std::unique_ptr<Driver> makeDriver(int kind, Wire& wire)
{
  auto transport = std::make_unique<MemoryTransport>(wire);
  switch (kind)
  {
    case 0:
      return std::make_unique<SpaceMouseDriver>(std::move(transport));
    case 1:
      return std::make_unique<WoodenDriver>(std::move(transport), WoodenArm{}, 14);
    case 2:
      return std::make_unique<Phd1Driver>(std::move(transport));
    default:
      return std::make_unique<FalconDriver>(std::move(transport), Packet{});
  }
}

class EveryDriver : public ::testing::TestWithParam<int>
{
};
INSTANTIATE_TEST_SUITE_P(Drivers, EveryDriver, ::testing::Range(0, 4));

TEST_P(EveryDriver, NoticesThatItsDeviceIsGone)
{
  Falcon wire;
  const auto driver = makeDriver(GetParam(), wire);
  wire.gone = true;
  DriverSample sample;
  EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone);
}

TEST_P(EveryDriver, BearsGarbageAndNeverGivesAPlaceThatIsNotFinite)
{
  Falcon wire;
  const auto driver = makeDriver(GetParam(), wire);
  std::mt19937 random(9);
  for (int i = 0; i < 5000; ++i)
  {
    Packet packet(random() % 66);
    for (std::byte& byte : packet)
    {
      byte = static_cast<std::byte>(random());
    }
    wire.replies.push_back(packet);
    DriverSample sample;
    (void)driver->tick(Vector3d(NAN, 1e9, -1e9), 1.0_ms, sample);
    ASSERT_TRUE(sample.position.allFinite());
  }
}

// what a made up device was told and what it does, kept beyond the life of its drivers
struct Fake
{
  std::atomic<int> opened = 0;
  std::atomic<int> losses = 0;
  std::atomic<bool> pulled = false;
  std::atomic<bool> homed = true;
  std::atomic<bool> stopped = false;
  std::atomic<int> failing = 0;     // transfers that do not reach it, from now on
  std::atomic<double> last = 0.0;   // size of the last force that reached it [N]
  std::atomic<double> left = 0.0;   // the same, when its driver was closed
  std::vector<Vector3d> forces;     // read after the thread has ended
  std::atomic<bool> blocks = false; // its bus: no transfer comes to an end
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

  IoCode tick(const Vector3d& force, double, DriverSample& sample) noexcept override
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
    fake_.forces.push_back(force);
    fake_.last = force.norm();
    sample = { .position = Vector3d(1.0_mm, 2.0_mm, 3.0_mm + ++ticks_ * 1.0_um),
      .homed = fake_.homed,
      .stopped = fake_.stopped };
    return IoCode::Ok;
  }

private:
  Fake& fake_;
  int ticks_ = 0;
};

ThreadedDevice::Open opening(Fake& fake)
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

TEST(ThreadedDevice, StandsWhereItIsPlacedAndEndsWithZeroForce)
{
  Fake fake;
  {
    DevicePlacement placement;
    placement.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; // a quarter turn about z
    placement.origin = Vector3d(0.1, 0, 0);
    ThreadedDevice device(opening(fake), placement);
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

TEST(ThreadedDevice, GivesTheNewestPoseWithoutWaitingForASlowBus)
{
  Fake fake;
  ThreadedDevice device(opening(fake), {});
  fake.blocks = true;
  while (!fake.blocked)
  {
    std::this_thread::sleep_for(1ms);
  }
  const double newest = device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z();
  double age = 0.0;
  for (int i = 0; i < 100; ++i)
  {
    EXPECT_EQ(device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z(), newest);
    EXPECT_GE(device.status().age, age);
    age = device.status().age;
  }
  fake.blocks = false;
  exchangeUntil(device, Vector3d::Zero(),
    [&](const auto& pose)
    {
      EXPECT_GE(pose->apex.z(), newest); // never an older one
      return pose->apex.z() > newest;
    });
}

TEST(ThreadedDevice, NoPoseIsYoungerThanNow)
{
  Fake fake;
  ThreadedDevice device(opening(fake), {});
  double youngest = 0.0;
  for (double newest = 0.0; newest < 3.5_mm;) // 500 exchanges, each asked for all the time
  {
    newest = device.exchange(Vector3d::Zero(), 1.0_ms)->apex.z();
    youngest = std::min(youngest, device.status().age);
  }
  EXPECT_EQ(youngest, 0.0);
}

TEST(ThreadedDevice, PassesOnThatItsDeviceIsStopped)
{
  Fake fake;
  fake.stopped = true;
  ThreadedDevice device(opening(fake), {});
  EXPECT_TRUE(device.exchange(Vector3d::Zero(), 1.0_ms));
  EXPECT_TRUE(device.status().stopped);
}

// some errors pass: a device that is still there would hold the last force for ever
TEST(ThreadedDevice, ATransferThatFailsLeavesNoForceInTheMotors)
{
  for (const int failing : { 1, 4 })
  {
    Fake fake;
    ThreadedDevice device(opening(fake), {});
    exchangeUntil(device, Vector3d(0, 0, 3), [&](const auto&) { return fake.last == 3.0; });
    fake.failing = failing;
    while (fake.opened < 2)
    {
      std::this_thread::sleep_for(1ms);
    }
    EXPECT_EQ(fake.left, 0.0);
  }
}

TEST(ThreadedDevice, AForceThatIsNotRenewedEnds)
{
  Fake fake;
  ThreadedDevice device(opening(fake), {});
  exchangeUntil(device, Vector3d(0, 0, 1), [&](const auto&) { return fake.last == 1.0; });
  while (fake.last != 0.0) // the servo has stalled
  {
    std::this_thread::sleep_for(1ms);
  }
}

TEST(ThreadedDevice, ComesBackWithANewDriverWhenItIsPluggedInAgain)
{
  Fake fake;
  ThreadedDevice device(opening(fake), {});
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
TEST(ThreadedDevice, TellsALossThatTheServoSlept)
{
  Fake fake;
  ThreadedDevice device(opening(fake), {});
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
  std::this_thread::sleep_for(50ms);
  EXPECT_FALSE(device.exchange(Vector3d::Zero(), 1.0_ms));
}

TEST(ThreadedDevice, ThatNeverAnswersIsRefusedInOneSentence)
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
    const ThreadedDevice device(open, {});
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
