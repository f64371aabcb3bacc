// libusb itself, against a Novint Falcon that is made up: umockdev gives it a place in /sys, this
// program answers the requests of usbfs. A FIFO in the place of the node wakes libusb's poll.

#include "app/devices_report.h"
#include "app/program/devices_options.h"
#include "haptics/devices/bus_device.h"
#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/falcon/falcon_kinematics.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/rigs/made_up_falcon.h"

#include <algorithm>
#include <chrono>
#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <thread>
#include <umockdev.h>
#include <vector>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;
using Packet = std::vector<std::byte>;

constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kDevice = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-3";
constexpr const char* kRecord =
  "P: /devices/pci0000:00/0000:00:14.0/usb1/1-3\nN: bus/usb/001/002=00\n"
  "E: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=002\n"
  "E: DEVNAME=/dev/bus/usb/001/002\nE: MAJOR=189\nE: MINOR=1\n"
  "A: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=2\\n\nA: speed=12\\n\n"
  "A: idVendor=0403\\n\nA: idProduct=cb48\\n\n"
  "H: descriptors=1201000200000040030448CB000600000001"
  "0902200001010080320904000002FFFFFF000705810240000007050202400000\n\n";

class FalconRig : public ::testing::Test
{
protected:
  void SetUp() override
  {
    bed_ = umockdev_testbed_new();
    if (!umockdev_in_mock_environment())
    {
      GTEST_SKIP() << "umockdev's preload library is not loaded";
    }
    ASSERT_TRUE(listUsb().empty());
    plugIn();
  }

  void plugIn()
  {
    GError* error = nullptr;
    ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, kRecord, &error)) << error->message;
    falcon_ = std::make_unique<MadeUpFalcon>();
    gchar* root = umockdev_testbed_get_root_dir(bed_);
    falcon_->ringAt(std::string(root) + kNode);
    g_free(root);
    gFalcon = falcon_.get();
  }

  void TearDown() override
  {
    gFalcon = nullptr;
    falcon_.reset();
    g_object_unref(bed_);
  }

  void unplug()
  {
    falcon_->unplug();
    umockdev_testbed_uevent(bed_, kDevice, "remove");
    umockdev_testbed_remove_device(bed_, kDevice);
  }

  // true when it answers
  static bool answers(FalconDriver& driver)
  {
    DriverSample sample;
    return driver.tick(Vector3d::Zero(), 1.0_ms, sample) == IoCode::Ok;
  }

  // as long as a machine under load may take
  static void untilAnswered(FalconDriver& driver, const Vector3d& force, DriverSample& sample)
  {
    const auto end = Clock::now() + 60s;
    while (driver.tick(force, 1.0_ms, sample) != IoCode::Ok)
    {
      if (Clock::now() > end)
      {
        throw std::runtime_error("no answer within a minute");
      }
    }
  }

  static std::vector<std::byte> someFirmware()
  {
    std::vector<std::byte> firmware(7914);
    for (std::size_t i = 0; i < firmware.size(); ++i)
    {
      firmware[i] = static_cast<std::byte>(i * 131 + 7);
    }
    return firmware;
  }

  UMockdevTestbed* bed_ = nullptr;
  std::unique_ptr<MadeUpFalcon> falcon_;
};

TEST_F(FalconRig, IsFound)
{
  const auto found = listUsb();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, DeviceKind::Falcon);
  EXPECT_EQ(found[0].unusableReason, "");
}

TEST_F(FalconRig, LoadsTheFirmwareByteForByteOnlyWhereNoneRuns)
{
  {
    const FalconDriver driver(openFalcon(), someFirmware());
    EXPECT_EQ(falcon_->firmware, someFirmware());
  }
  falcon_->firmware.clear();
  const FalconDriver again(openFalcon(), {});
  EXPECT_TRUE(falcon_->firmware.empty());
}

TEST_F(FalconRig, SaysThatFirmwareIsMissing)
{
  EXPECT_THROW(FalconDriver(openFalcon(), {}), Error);
}

TEST_F(FalconRig, DevicesTellsThatItsFirmwareIsMissing)
{
  for (const bool loaded : { false, true })
  {
    falcon_->loaded = loaded;
    testing::internal::CaptureStdout();
    EXPECT_EQ(showDevices({}), loaded ? 0 : 6);
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find(loaded ? ": can be used" : ": has no firmware since"), text.npos) << text;
  }
}

// a machine under load may answer late: that is no loss
TEST_F(FalconRig, ClosedLoopLosesNoReply)
{
  falcon_->loaded = true;
  const auto wire = openFalcon();
  ASSERT_TRUE(wire->request(3, 0x2)); // to full speed
  ASSERT_TRUE(wire->request(6, 0x100 | '>'));
  FalconReader reader;
  std::vector<double> times; // [us]
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i)
  {
    const auto begin = Clock::now();
    ASSERT_EQ(wire->write(encode(FalconCommand{})), IoCode::Ok);
    std::optional<FalconState> state;
    while (!state)
    {
      std::array<std::byte, 64> packet{};
      const IoResult result = wire->read(packet, 60s);
      ASSERT_EQ(result.code, IoCode::Ok);
      state = reader.take(Bytes(packet).first(result.size).subspan(2));
    }
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
  }
  std::nth_element(times.begin(), times.begin() + kTicks / 2, times.end());
  std::printf("median exchange %.1f us\n", times[kTicks / 2]); // a report, not a gate
  EXPECT_EQ(falcon_->packets, kTicks);
}

TEST_F(FalconRig, RepliesThatComeLateAreForgotten)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  falcon_->mood = Mood::Silent;
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout);
  }
  falcon_->mood = Mood::Good;
  falcon_->homed = true; // what the late replies do not know
  untilAnswered(driver, Vector3d::Zero(), sample);
  EXPECT_TRUE(sample.homed);
}

TEST_F(FalconRig, NoTorqueComesBeforeHoming)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  for (int i = 0; i < 200; ++i)
  {
    untilAnswered(driver, Vector3d(0, 0, -1), sample);
  }
  EXPECT_TRUE(falcon_->repliesAtOnce()); // not when its timer of 1 ms runs out
  EXPECT_EQ(falcon_->torque, 0);
  EXPECT_EQ(falcon_->lights & 0xE, 0x8); // red: home it
  falcon_->counts = 0;
  falcon_->homed = true;
  for (int i = 0; i < 200; ++i)
  {
    untilAnswered(driver, Vector3d(0, 0, -1), sample);
  }
  EXPECT_EQ(falcon_->torque, 0); // until the grip was pulled out once
  EXPECT_FALSE(sample.homed);
  EXPECT_EQ(falcon_->lights & 0xE, 0x4); // blue
  falcon_->counts = 1000;
  while (falcon_->torque == 0)
  {
    (void)driver.tick(Vector3d(0, 0, -1), 1.0_ms, sample);
  }
  EXPECT_EQ(falcon_->tooEarly, 0);
  EXPECT_TRUE(sample.homed);
  EXPECT_EQ(sample.buttons, 5U);
  EXPECT_NEAR(sample.position.z(), 0.1736 - 0.125, 1e-4);
  untilAnswered(driver, Vector3d(0, 0, -1), sample);
  EXPECT_EQ(falcon_->lights & 0xE, 0x2); // green
}

// by the work that a small motion does: torques times the way of the legs is force times the way
// of the grip
TEST_F(FalconRig, MotorsGetTheTorquesOfTheForce)
{
  falcon_->loaded = true;
  falcon_->homed = true;
  FalconDriver driver(openFalcon(), {});
  DriverSample sample;
  untilAnswered(driver, Vector3d::Zero(), sample); // pulled out
  falcon_->counts = 0;
  untilAnswered(driver, Vector3d::Zero(), sample);
  const Vector3d place = sample.position + falconCenter(); // all encoders at zero
  for (const Vector3d& force : { Vector3d(0, 0, -8), Vector3d(5, 0, 2), Vector3d(-2, 6, -3) })
  {
    untilAnswered(driver, force, sample); // so that it has been taken up
    Vector3d felt;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = 1.0_um * Vector3d::Unit(axis);
      const Vector3d change = *falconAngles(place + step) - *falconAngles(place - step);
      const Vector3d torques(falcon_->torques[0], falcon_->torques[1], falcon_->torques[2]);
      felt[axis] = -torques.dot(change) / 2.0_um / 2300.0; // counts in a newton meter
    }
    EXPECT_NEAR(felt.norm(), force.norm(), 0.01 * force.norm());
    EXPECT_LT(std::acos(std::min(1.0, felt.normalized().dot(force.normalized()))), 0.5_deg);
  }
}

TEST_F(FalconRig, FindsRepliesThatAreSplitOrFollowGarbage)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  for (const Mood mood : { Mood::Split, Mood::Garbage })
  {
    falcon_->mood = mood;
    for (int i = 0; i < 200; ++i)
    {
      DriverSample sample;
      untilAnswered(driver, Vector3d::Zero(), sample);
      ASSERT_TRUE(sample.position.allFinite());
    }
  }
}

TEST_F(FalconRig, SilenceAndStallsAreTimeoutsAndNoHang)
{
  falcon_->loaded = true;
  FalconDriver driver(openFalcon(), {});
  for (const Mood mood : { Mood::Silent, Mood::Stalled })
  {
    falcon_->mood = mood;
    DriverSample sample;
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Timeout);
  }
  falcon_->mood = Mood::Good;
  while (!answers(driver)) // goes on as if nothing had been
  {
  }
}

TEST_F(FalconRig, IsSilentThenGoneThenBack)
{
  falcon_->loaded = true;
  BusDevice device([] { return std::make_unique<FalconDriver>(openFalcon(), Packet{}); }, {});
  falcon_->mood = Mood::Silent;
  while (device.exchange(Vector3d::Zero(), 1.0_ms) && device.status().age < 20.0_ms)
  {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_GE(device.status().age, 20.0_ms);
  unplug();
  while (device.exchange(Vector3d::Zero(), 1.0_ms) || falcon_->claimed)
  {
    std::this_thread::sleep_for(1ms);
  }
  gFalcon = nullptr;
  falcon_.reset();
  plugIn();
  falcon_->loaded = true;
  while (!device.exchange(Vector3d::Zero(), 1.0_ms))
  {
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_FALSE(device.status().homed);
}

TEST_F(FalconRig, UnplugIsNoticedInAnyState)
{
  for (const int ticks : { 0, 1, 50 })
  {
    falcon_->loaded = true;
    FalconDriver driver(openFalcon(), {});
    DriverSample sample;
    for (int i = 0; i < ticks; ++i)
    {
      (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
    }
    unplug();
    EXPECT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Gone) << ticks;
    EXPECT_THROW((void)openFalcon(), Error);
    if (ticks < 50)
    {
      TearDown();
      SetUp();
    }
  }
}

} // namespace
} // namespace palp
