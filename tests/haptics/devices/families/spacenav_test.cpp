// libspnav against a made-up daemon.

#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/devices/families/spacenav_daemon.h"
#include "tests/haptics/devices/memory_transport.h"

#include <chrono>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <thread>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

// the same twist and push of the same mouse, read from its own reports
DriverSample bySpaceMouse(const Axes& raw, int ticks)
{
  Wire wire;
  SpaceMouseDriver driver(std::make_unique<MemoryTransport>(wire));
  DriverSample sample;
  for (int i = 0; i < ticks; ++i)
  {
    Packet report(13);
    report[0] = std::byte{ 1 };
    for (std::size_t axis = 0; axis < 6; ++axis)
    {
      writeInt(report, 1 + 2 * axis, static_cast<std::int16_t>(raw[axis]));
    }
    wire.replies.push_back(report);
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
  }
  return sample;
}

TEST(Spacenavd, MovesTheToolAsTheMouseItselfDoes)
{
  for (std::size_t axis = 0; axis < 6; ++axis)
  {
    SpacenavDaemon daemon;
    const auto driver = openDriver("spacenavd");
    Axes raw{};
    raw[axis] = 350;
    DriverSample sample;
    for (int i = 0; i < 100; ++i)
    {
      daemon.move(raw);
      ASSERT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    }
    const DriverSample same = bySpaceMouse(raw, 100);
    EXPECT_LT((sample.position - same.position).norm(), 1e-12) << axis;
    EXPECT_LT(sample.orientation.angularDistance(same.orientation), 1e-9) << axis;
    EXPECT_NEAR(sample.position.norm() / 6.0_mm + // at full deflection, or a turn of 0.1 rad
        sample.orientation.angularDistance(Eigen::Quaterniond::Identity()) / 0.1,
      1.0, 1e-3);
  }
}

TEST(Spacenavd, ButtonsAreHeldUntilTheyAreReleased)
{
  SpacenavDaemon daemon;
  const auto driver = openDriver("spacenavd");
  DriverSample sample;
  daemon.press(0, true);
  daemon.press(9, true);
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  EXPECT_EQ(sample.buttons, 0x201U);
  daemon.press(0, false);
  daemon.press(99, true); // none of a mouse's
  (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  EXPECT_EQ(sample.buttons, 0x200U);
}

TEST(Spacenavd, ItsSecondButtonHoldsTheTool)
{
  SpacenavDaemon daemon;
  const auto device = openDevice("spacenavd", { .clutch = 2 });
  const auto push = [&]
  {
    std::optional<ToolPose> pose;
    for (int i = 0; i < 20; ++i)
    {
      daemon.move({ 350, 0, 0, 0, 0, 0 });
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      pose = device->exchange(Vector3d::Zero(), 1.0_ms);
    }
    return pose->apex;
  };
  daemon.press(1, true);
  EXPECT_EQ(push(), push());
  EXPECT_TRUE(device->status().clutched);
  daemon.press(1, false);
  const Vector3d before = push();
  EXPECT_GT(push().x(), before.x());
  EXPECT_FALSE(device->status().clutched);
}

TEST(Spacenavd, AnOldDaemonThatKnowsOneProtocolIsUnderstood)
{
  SpacenavDaemon daemon(true);
  const auto driver = openDriver("spacenavd");
  DriverSample sample;
  daemon.move({ 350, 0, 0, 0, 0, 0 });
  for (int i = 0; i < 50; ++i)
  {
    (void)driver->tick(Vector3d::Zero(), 1.0_ms, sample);
  }
  EXPECT_NEAR(sample.position.x(), 3.0_mm, 0.1_mm);
}

TEST(Spacenavd, ItsEndIsToldAndItsAbsenceIsOneSentence)
{
  SpacenavDaemon daemon;
  {
    const auto driver = openDriver("spacenavd");
    DriverSample sample;
    daemon.move({ 350, 0, 0, 0, 0, 0 });
    EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    daemon.stop();
    EXPECT_EQ(driver->tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone);
  }
  setenv("SPNAV_SOCKET", "/nowhere/spnav.sock", 1);
  try
  {
    (void)openDriver("spacenavd");
    FAIL() << "a daemon runs here";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::NoDevice);
    EXPECT_NE(std::string(error.what()).find("start it"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace palp
