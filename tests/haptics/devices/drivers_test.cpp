#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/devices/memory_transport.h"
#include "tests/support/wooden_reference.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <string>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

TEST(Phd1Driver, SendsForceOnlyToABoardThatIsHomedAndNotStopped)
{
  Wire wire;
  Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
  Phd1State state;
  const auto tick = [&]
  {
    ++state.sequence;
    state.microseconds += 1000;
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
  for (std::uint16_t i = 0; i < 2; ++i)
  {
    wire.replies.push_back(packetOf(
      encode(Phd1State{ .homed = true, .stopped = true, .sequence = i, .microseconds = i })));
    EXPECT_EQ(driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample), IoCode::Ok);
  }
  EXPECT_TRUE(sample.homed);
  EXPECT_TRUE(sample.stopped);
  EXPECT_EQ(decodePhd1Command(Bytes(wire.heard.back()).subspan(1))->order, Phd1Order::Idle);
}

// its firmware hangs, its USB part goes on: nothing of that is a pose
TEST(Phd1Driver, ABoardThatRepeatsItsReportIsSilent)
{
  for (const bool clockStands : { true, false })
  {
    Wire wire;
    Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
    DriverSample sample;
    int fresh = 0;
    for (std::uint16_t i = 0; i < 100; ++i)
    {
      const bool hangs = i >= 50;
      wire.replies.push_back(packetOf(encode(Phd1State{ .homed = true,
        .sequence = static_cast<std::uint16_t>(hangs && !clockStands ? 49 : i),
        .microseconds = hangs && clockStands ? 49'000U : 1000U * i })));
      fresh += driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample) == IoCode::Ok ? 1 : 0;
    }
    EXPECT_EQ(fresh, 50) << clockStands;
  }
}

TEST(Phd1Driver, MovesNoBoardThatNobodyAskedToHome)
{
  Wire wire;
  Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
  DriverSample sample;
  std::uint16_t sequence = 0;
  const auto orderAfter = [&](bool homed)
  {
    ++sequence;
    wire.replies.push_back(packetOf(encode(Phd1State{ .homed = homed,
      .sequence = sequence,
      .microseconds = 1000U * sequence,
      .temperature = 41 })));
    (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
    return decodePhd1Command(Bytes(wire.heard.back()).subspan(1))->order;
  };
  for (int i = 0; i < 10; ++i)
  {
    EXPECT_EQ(orderAfter(false), Phd1Order::Idle);
  }
  EXPECT_EQ(sample.temperature, 41.0);
  driver.home();
  EXPECT_EQ(orderAfter(true), Phd1Order::Home);
  EXPECT_EQ(orderAfter(true), Phd1Order::Force);
}

// of the interfaces that a receiver shows, the mouse talks on one
TEST(SpaceMouseDriver, HearsTheInterfaceThatTalksInAllSixAxes)
{
  std::array<Wire, 5> wires;
  std::vector<std::unique_ptr<Transport>> transports;
  for (Wire& wire : wires)
  {
    transports.push_back(std::make_unique<MemoryTransport>(wire));
  }
  SpaceMouseDriver driver(std::move(transports));
  DriverSample sample;
  for (int i = 0; i < 100; ++i)
  {
    Packet report(13); // x and rz at their ends, all in one report as of a wireless one
    report[0] = std::byte{ 1 };
    writeInt<std::int16_t>(report, 1, 350);
    writeInt<std::int16_t>(report, 11, -350);
    wires[1].replies.push_back(report);
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  }
  EXPECT_NEAR(sample.position.x(), 6.0_mm, 0.1_mm);
  const Eigen::AngleAxisd turned(sample.orientation); // about z up, the other way than z down
  EXPECT_NEAR(turned.angle() * turned.axis().z(), 0.1, 1e-3);
  wires[0].gone = true; // a part of the receiver is not the mouse
  EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  for (Wire& wire : wires)
  {
    wire.gone = true;
  }
  EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone);
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
    EXPECT_EQ(wire.heard.back()[13], std::byte{ 'J' }); // keeps asking for homing, in red
  }
  wire.homed = true;
  (void)driver.tick(Vector3d(1, 2, 3), 1.0_ms, sample);
  EXPECT_FALSE(sample.homed);                             // until it was pulled out
  EXPECT_NEAR(sample.position.z(), 0.1346 - 0.125, 1e-4); // all encoders at zero
  wire.encoder = { 1000, 1000, 1000 };
  (void)driver.tick(Vector3d(1, 2, 3), 1.0_ms, sample);
  EXPECT_TRUE(isZeroTorque(wire.heard.back()));
  EXPECT_TRUE(sample.homed);
  (void)driver.tick(Vector3d(0, 0, -1), 1.0_ms, sample);
  // the makers' traces pair a force into the device with counts above zero: the highest of the four
  // letters of each motor is A, and another is not
  for (std::size_t motor = 0; motor < 3; ++motor)
  {
    const auto letters = Bytes(wire.heard.back()).subspan(1 + 4 * motor, 4);
    EXPECT_EQ(letters[3], std::byte{ 'A' });
    EXPECT_NE(letters[1], std::byte{ 'A' });
  }
  EXPECT_EQ(wire.requests[6], 0x13E); // SIO_SET_EVENT_CHAR_REQUEST: '>', on
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

} // namespace
} // namespace palp
