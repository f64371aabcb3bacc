#include "app/devices_report.h"
#include "app/program/devices_options.h"
#include "haptics/devices/bus_device.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/rigs/hid_rig.h"

#include <cstdlib>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using namespace std::chrono_literals;
using Eigen::Vector3d;
using test::Board;
using test::kNode;

std::unique_ptr<Driver> openArm()
{
  return std::make_unique<WoodenDriver>(openHid(kNode), WoodenArm{}, 64);
}

using HidRig = test::HidRig;

TEST_F(HidRig, FindsTheBoardButOnlyAsOneOfManyWithItsIds)
{
  const auto found = listHid();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, DeviceKind::RawHid);
  EXPECT_EQ(found[0].name, "Polhem");
  EXPECT_EQ(found[0].ids, "16c0:0486");
  EXPECT_EQ(found[0].path, kNode);
}

struct Told
{
  int code;
  std::string text;
};

Told tellDevices(const DevicesOptions& options = {})
{
  testing::internal::CaptureStdout();
  const int code = showDevices(options);
  return { code, testing::internal::GetCapturedStdout() };
}

TEST_F(HidRig, DevicesTellsWhatIsThereAndWhyItCannotBeUsed)
{
  const Told there = tellDevices();
  EXPECT_EQ(there.code, 0);
  EXPECT_NE(there.text.find("Polhem (16c0:0486) at /dev/hidraw0: can be used"), there.text.npos)
    << there.text;

  test::gDenied = true;
  const Told denied = tellDevices();
  EXPECT_EQ(denied.code, 6);
  EXPECT_NE(denied.text.find("no permission; install the udev rules"), denied.text.npos);
  EXPECT_THROW((void)openArm(), Error);
  test::gDenied = false;

  unplug();
  const Told none = tellDevices();
  EXPECT_EQ(none.code, 3);
  EXPECT_NE(none.text.find("none; plug one in"), none.text.npos);
}

// none of them may reach hidapi, which uses such a device after it has freed it
TEST_F(HidRig, WhatIsNoHidDeviceIsRefusedByName)
{
  for (const char* path : { "/dev/null", "/dev/zero", "/etc/passwd", "/tmp", "/proc/self/mem" })
  {
    try
    {
      (void)openHid(path);
      ADD_FAILURE() << path;
    }
    catch (const Error& error)
    {
      EXPECT_EQ(error.code(), ErrorCode::NoDevice);
      EXPECT_TRUE(std::string(error.what()).starts_with(std::string(path) + ": ")) << error.what();
      EXPECT_EQ(std::string(error.what()).find("another program"), std::string::npos)
        << error.what();
    }
  }
  EXPECT_NE(openHid(kNode), nullptr);
}

TEST_F(HidRig, ProbeMeasuresTheExchange)
{
  const Told told = tellDevices({ .probe = std::string("wooden:") + kNode });
  EXPECT_EQ(told.code, 0);
  EXPECT_NE(told.text.find("exchanges answered in a second; median"), told.text.npos) << told.text;
  EXPECT_GT(board_->packets, 0);
  EXPECT_EQ(board_->pushes, 0); // zero force only
}

// 500 of 2000 counts, 10 mm on 160 mm: 98 mrad, at a reach of 220 mm some 20 mm
TEST_F(HidRig, ProbeFindsAnEncoderThatLeaps)
{
  board_->mood = Board::Mood::Leaping;
  const Told told = tellDevices({ .probe = std::string("wooden:") + kNode });
  EXPECT_EQ(told.code, 6);
  EXPECT_NE(told.text.find("its position leaps by "), told.text.npos) << told.text;
}

// a machine under load may answer late: that is no loss
TEST_F(HidRig, ClosedLoopLosesNoReply)
{
  const auto wire = openHid(kNode);
  std::vector<double> times; // [us]
  int answered = 0;
  constexpr int kTicks = 5000;
  for (int i = 0; i < kTicks; ++i)
  {
    std::array<std::byte, 65> out{};
    encodeWooden({ 1.0, 0.0, 0.0 }, MutableBytes(out).subspan(1));
    std::array<std::byte, 64> in{};
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(wire->write(out), IoCode::Ok);
    IoResult result{ IoCode::Timeout, 0 };
    for (int second = 0; result.code == IoCode::Timeout && second < 60; ++second)
    {
      result = wire->read(in, 1s);
    }
    times.push_back(
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    // the encoder, which began at 5, moves one count with each ampere that arrived
    answered +=
      result.size == in.size() && decodeWooden(in)->encoders[0] == static_cast<std::int16_t>(i + 6);
    std::this_thread::sleep_for(50us);
  }
  std::nth_element(times.begin(), times.begin() + kTicks / 2, times.end());
  std::printf("median exchange %.1f us\n", times[kTicks / 2]); // a report, not a gate
  EXPECT_EQ(answered, kTicks);
  EXPECT_EQ(board_->packets, kTicks);
}

TEST_F(HidRig, NoCurrentReachesTheBoardBeforeItsCalibration)
{
  const auto arm = openArm();
  DriverSample sample;
  while (board_->last == 0)
  {
    ASSERT_LT(board_->packets, 5000);
    (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
  }
  EXPECT_EQ(board_->beforeCalibration, 0);
  EXPECT_TRUE(sample.homed);
}

// counters mean nothing when the board is plugged in
TEST_F(HidRig, OnceCalibratedThePoseIsThatOfTheArm)
{
  const auto arm = openArm();
  DriverSample sample;
  while (!sample.homed || (sample.position - test::woodenTool(Board::kStart)).norm() > 1e-9)
  {
    ASSERT_LT(board_->packets, 5000) << "the driver sees " << sample.position.transpose();
    (void)arm->tick(Vector3d::Zero(), 1.0_ms, sample);
  }
}

TEST_F(HidRig, UnplugIsNoticedInAnyState)
{
  for (const int ticks : { 0, 1, 2, 50 })
  {
    const auto arm = openArm();
    DriverSample sample;
    for (int i = 0; i < ticks; ++i)
    {
      (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
    }
    unplug();
    EXPECT_EQ(arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample), IoCode::Gone) << ticks;
    EXPECT_THROW((void)openArm(), Error);
    plugIn();
  }
}

TEST_F(HidRig, SilenceIsToldByTheAgeOfThePose)
{
  BusDevice device(&openArm, {});
  board_->mood = Board::Mood::Silent;
  while (device.status().age <= 20.0_ms) // as long as a machine under load may take
  {
    std::this_thread::sleep_for(1ms);
    ASSERT_TRUE(device.exchange(Vector3d(0, 0, 1), 1.0_ms));
  }
}

TEST_F(HidRig, GarbageGivesNoPlaceThatIsNotFinite)
{
  const auto arm = openArm();
  board_->mood = Board::Mood::Garbage;
  for (int i = 0; i < 1000; ++i)
  {
    DriverSample sample;
    (void)arm->tick(Vector3d(0.5, 0, 0.5), 1.0_ms, sample);
    ASSERT_TRUE(sample.position.allFinite());
  }
}

TEST_F(HidRig, LastWordsOfADeviceAreZero)
{
  {
    BusDevice device(&openArm, {});
    while (board_->last == 0) // as long as a machine under load may take
    {
      (void)device.exchange(Vector3d(0.5, 0, 0.5), 1.0_ms);
      std::this_thread::sleep_for(1ms);
    }
  }
  while (board_->last != 0)
  {
    std::this_thread::sleep_for(1ms);
  }
}

} // namespace
} // namespace palp
