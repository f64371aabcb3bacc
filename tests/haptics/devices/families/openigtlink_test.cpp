#include "haptics/devices/bus_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/units.h"
#include "tests/haptics/devices/families/igtl_peer.h"
#include "tests/haptics/devices/families/one_sentence.h"
#include "tests/support/allocation_guard.h"

#include <chrono>
#include <gtest/gtest.h>
#include <numbers>
#include <thread>

namespace palp
{
namespace
{

using namespace test;
using namespace std::chrono_literals;
using namespace units::literals;
using Eigen::Vector3d;
using Clock = std::chrono::steady_clock;

// below those that the system gives out, and another for each test that runs at the same time
const auto kPort = static_cast<std::uint16_t>(20'000 + getpid() % 12'000);

const std::string kName = "openigtlink::" + std::to_string(kPort);

// ticks until a pose has come, or not
IoCode heard(Driver& driver, DriverSample& sample, const Vector3d& force = Vector3d::Zero())
{
  IoCode code = IoCode::Timeout;
  for (int i = 0; i < 200 && !(code == IoCode::Ok && sample.homed); ++i)
  {
    code = driver.tick(force, 1.0_ms, sample);
    std::this_thread::sleep_for(100us);
  }
  return sample.homed ? code : IoCode::Timeout;
}

TEST(OpenIgtLink, TheChecksumOfItsPeerIsThePublishedOne)
{
  EXPECT_EQ(crcEcma({ '1', '2', '3', '4', '5', '6', '7', '8', '9' }), 0x6C40DF5F0B497347ULL);
}

TEST(OpenIgtLink, ATransformIsAPlaceInMillimetersAndATurn)
{
  const auto driver = openDriver(kName);
  DriverSample sample;
  EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  EXPECT_FALSE(sample.homed); // there, but no tracker is
  IgtlPeer peer(kPort);
  ASSERT_TRUE(peer.connected());
  ASSERT_TRUE(peer.say(turned("Probe", 10.0F, -20.0F, 30.5F)));
  ASSERT_EQ(heard(*driver, sample), IoCode::Ok);
  EXPECT_LT((sample.position - Vector3d(0.010, -0.020, 0.0305)).norm(), 1e-8);
  const Eigen::AngleAxisd turn(sample.orientation);
  EXPECT_NEAR(turn.angle() * turn.axis().z(), std::numbers::pi / 2, 1e-6);
  EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout); // nothing new
  EXPECT_FALSE(driver->limits().rendersForce);
}

TEST(OpenIgtLink, APositionMayComeWithoutItsOrientationAndWithMetadata)
{
  const auto driver = openDriver(kName + ",Tool");
  IgtlPeer peer(kPort);
  DriverSample sample;
  const float half = std::sqrt(0.5F);
  for (const Octets& body :
    { floats({ 1, 2, 3 }), floats({ 1, 2, 3, half, 0, 0 }), floats({ 1, 2, 3, half, 0, 0, half }) })
  {
    for (const bool extended : { false, true })
    {
      Octets whole;
      if (extended) // its own size, that of 1 key, of its text, and a number
      {
        put(whole, 12, 2);
        put(whole, 10, 2);
        put(whole, 8, 4);
        put(whole, 77, 4);
      }
      whole.insert(whole.end(), body.begin(), body.end());
      whole.insert(whole.end(), extended ? 18 : 0, 'm');
      sample = {};
      sample.homed = false;
      ASSERT_TRUE(peer.say(turned("Other", 9, 9, 9)));
      ASSERT_TRUE(peer.say(message("POSITION", "Tool", whole, extended ? 2 : 1)));
      ASSERT_EQ(heard(*driver, sample), IoCode::Ok);
      EXPECT_LT((sample.position - Vector3d(0.001, 0.002, 0.003)).norm(), 1e-9);
      EXPECT_NEAR(sample.orientation.angularDistance(Eigen::Quaterniond::Identity()),
        body.size() > 12 ? std::numbers::pi / 2 : 0.0, 1e-4);
    }
  }
}

TEST(OpenIgtLink, TheForceGoesOutAsASensorInNewtons)
{
  const auto driver = openDriver(kName);
  IgtlPeer peer(kPort);
  DriverSample sample;
  Octets told;
  for (int i = 0; i < 1000; ++i)
  {
    (void)driver->tick(Vector3d(0.25, -1.5, 3.0), 1.0_ms, sample);
    const Octets more = peer.hear();
    told.insert(told.end(), more.begin(), more.end());
  }
  std::this_thread::sleep_for(10ms);
  const Octets more = peer.hear();
  told.insert(told.end(), more.begin(), more.end());
  ASSERT_GE(told.size(), 92U * 90U); // a hundred times a second
  ASSERT_LE(told.size(), 92U * 101U);
  const Octets type(told.begin() + 2, told.begin() + 9);
  EXPECT_EQ(std::string(type.begin(), type.end()), std::string("SENSOR\0", 7));
  EXPECT_EQ(get(told, 42, 8), 34U);
  EXPECT_EQ(get(told, 50, 8), crcEcma(Octets(told.begin() + 58, told.begin() + 92)));
  EXPECT_EQ(told[58], 3U);
  // unit.md: no prefix in the first 4 bits, newton in the next 6, exponent 1 in the next 4
  EXPECT_EQ(get(told, 60, 8), 0x0BULL << 54 | 1ULL << 50);
  const auto value = [&](std::size_t i) { return std::bit_cast<double>(get(told, 68 + 8 * i, 8)); };
  EXPECT_EQ(Vector3d(value(0), value(1), value(2)), Vector3d(0.25, -1.5, 3.0));
}

TEST(OpenIgtLink, WhatNoToolCanDoIsNoPose)
{
  const auto driver = openDriver(kName);
  IgtlPeer peer(kPort);
  const float nan = std::nanf("");
  Octets damaged = turned("Probe", 1, 2, 3);
  damaged.back() ^= 1U; // its checksum does not fit
  for (const Octets& wrong :
    { turned("Probe", nan, 0, 0), turned("Probe", 1e30F, 0, 0), damaged,
      message("TRANSFORM", "Probe", floats({ 2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 })),
      message("TRANSFORM", "Probe", floats({ 1, 0, 0, 0, 1, 0, 0, 0, -1, 0, 0, 0 })),
      message("TRANSFORM", "Probe", floats({ 1, 2, 3 })), message("POSITION", "Probe", floats({})),
      message("POSITION", "Probe", floats({ 0, 0, 0, 0, 0, 0, 0 })),
      message("TRANSFORM", "Probe", { 0xFF, 0xFF, 0, 0 }, 2), message("STATUS", "Probe", {}),
      message("IMAGE", "Probe", Octets(100'000, 7)) })
  {
    ASSERT_TRUE(peer.say(wrong));
  }
  DriverSample sample;
  sample.homed = false;
  EXPECT_EQ(heard(*driver, sample), IoCode::Timeout);
  ASSERT_TRUE(peer.say(turned("Probe", 1, 2, 3))); // goes on after all of them
  EXPECT_EQ(heard(*driver, sample), IoCode::Ok);
  EXPECT_LT((sample.position - Vector3d(0.001, 0.002, 0.003)).norm(), 1e-9);
}

// half a message, a body of 100 MB, nothing read: no tick of anybody waits for it
TEST(OpenIgtLink, APeerThatStallsHoldsUpNoTickAndGivesWayToTheNext)
{
  const auto driver = openDriver(kName);
  IgtlPeer stalled(kPort);
  Octets half = turned("Probe", 1, 2, 3);
  half.resize(70);
  ASSERT_TRUE(stalled.say(half));
  Octets large = message("IMAGE", "Video", {});
  for (std::size_t i = 0; i < 8; ++i)
  {
    large[42 + i] = static_cast<unsigned char>(100'000'000ULL >> (8 * (7 - i)));
  }
  ASSERT_TRUE(stalled.say(large));
  DriverSample sample;
  std::chrono::nanoseconds longest{ 0 };
  AllocationGuard guard;
  for (int i = 0; i < 2000; ++i) // two of its seconds
  {
    const auto begin = Clock::now();
    (void)driver->tick(Vector3d(0, 0, 1), 1.0_ms, sample);
    longest = std::max<std::chrono::nanoseconds>(longest, Clock::now() - begin);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_LT(longest, 50ms);
  EXPECT_FALSE(sample.homed);
  IgtlPeer next(kPort);
  ASSERT_TRUE(next.say(turned("Probe", 4, 5, 6)));
  EXPECT_EQ(heard(*driver, sample), IoCode::Ok);
  EXPECT_LT((sample.position - Vector3d(0.004, 0.005, 0.006)).norm(), 1e-9);
  EXPECT_TRUE(stalled.isLetGo());
}

TEST(OpenIgtLink, WhoSpeaksAnotherProtocolIsLetGo)
{
  const auto driver = openDriver(kName);
  IgtlPeer browser(kPort);
  const std::string words =
    "GET / HTTP/1.1\r\nHost: localhost:18944\r\nUser-Agent: of someone\r\n\r\n";
  ASSERT_TRUE(browser.say(Octets(words.begin(), words.end())));
  DriverSample sample;
  sample.homed = false;
  EXPECT_EQ(heard(*driver, sample), IoCode::Timeout);
  EXPECT_TRUE(browser.isLetGo());
}

// through the device that a servo uses, whose pose is then as old as the tracker's
TEST(OpenIgtLink, MovesATool)
{
  const auto device = openDevice(kName, { .origin = Vector3d(0, 0, 0.1) });
  IgtlPeer peer(kPort);
  ASSERT_TRUE(peer.say(turned("Probe", 10, 0, 0)));
  std::optional<ToolPose> pose;
  for (int i = 0; i < 500 && !(pose && pose->apex.x() > 0.0); ++i)
  {
    pose = device->exchange(Vector3d::Zero(), 1.0_ms);
    std::this_thread::sleep_for(1ms);
  }
  ASSERT_TRUE(pose);
  EXPECT_LT((pose->apex - Vector3d(0.01, 0, 0.1)).norm(), 1e-8);
}

TEST(OpenIgtLink, SaysInOneSentenceWhyItCannotListen)
{
  const auto first = openDriver(kName);
  for (const std::string& name :
    { kName, std::string("openigtlink:127.0.0.1:0"), std::string("openigtlink:nowhere"),
      std::string("openigtlink:8.8.8.8"), std::string("openigtlink:127.0.0.1:70000") })
  {
    expectRefusedInOneSentence(name);
  }
}

} // namespace
} // namespace palp
