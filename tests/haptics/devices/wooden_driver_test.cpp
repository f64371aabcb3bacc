#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/devices/memory_transport.h"
#include "tests/support/wooden_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

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

// the makers: amplifiers that hold 2 A for four seconds
TEST(WoodenDriver, AMotorGetsItsPeakForFourSecondsAndThenWhatItBearsForEver)
{
  MotorHeat heat(2.0, 1.0, 4.0);
  double atPeak = 0.0;
  double warned = -1.0;
  for (int i = 0; i < 60'000; ++i)
  {
    std::array<double, 3> currents{ 0.5, -2.0, 0.0 };
    heat.take(currents, 1.0_ms);
    atPeak += currents[1] == -2.0 ? 1.0_ms : 0.0;
    warned = warned < 0.0 && heat.fraction() > 0.8 ? i * 1.0_ms : warned;
    ASSERT_NEAR(currents[0] / currents[1], -0.25, 1e-12); // shortened, not turned
  }
  EXPECT_GT(atPeak, 3.5);
  EXPECT_LT(atPeak, 4.0);
  EXPECT_LT(warned, 3.2);
  std::array<double, 3> later{ 0.0, 2.0, 0.0 };
  heat.take(later, 1.0_ms);
  EXPECT_NEAR(later[1], 1.0, 0.05);
  for (int i = 0; i < 60'000; ++i)
  {
    std::array<double, 3> none{};
    heat.take(none, 1.0_ms);
  }
  later = { 0.0, 2.0, 0.0 };
  heat.take(later, 1.0_ms);
  EXPECT_EQ(later[1], 2.0);
}

// 4 A^2 towards 1, by the time constant at which 2 A for 4 s is as much as 1 A for ever
TEST(WoodenDriver, ACurrentCountsAsLongAsItFlows)
{
  MotorHeat heat(2.0, 1.0, 4.0);
  std::array<double, 3> currents{ 2.0, 0.0, 0.0 };
  heat.take(currents, 10.0); // of nothing
  EXPECT_EQ(heat.fraction(), 0.0);
  currents = {};
  heat.take(currents, 1.0);
  EXPECT_NEAR(heat.fraction(), 4.0 * (1.0 - std::pow(0.75, 0.25)), 1e-12);
}

TEST(WoodenDriver, SendsNoMoreThanItsMotorsBear)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  DriverSample sample;
  int largest = 0; // of the last second [mA]
  for (int i = 0; i < 12'000; ++i)
  {
    wire.replies.push_back(woodenReport(i == 0));
    (void)driver.tick(Vector3d(0, 0, 5), 1.0_ms, sample);
    for (std::size_t motor = 0; motor < 3 && i >= 11'000; ++motor)
    {
      largest =
        std::max(largest, std::abs(readInt<std::int16_t>(wire.heard.back(), 1 + 2 * motor)));
    }
    wire.heard.resize(1);
  }
  EXPECT_NEAR(largest, 1000, 50);
  EXPECT_NEAR(sample.heat, 1.0, 0.06);
}

// the makers add 10000 to encoder d while the button of the handle is down
TEST(WoodenDriver, TellsTheButtonOfItsHandle)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  DriverSample sample;
  for (const int turned : { 0, -300, 300 })
  {
    for (const bool pressed : { false, true })
    {
      Packet report = woodenReport(false);
      writeInt<std::int16_t>(report, 6, static_cast<std::int16_t>(turned + (pressed ? 10'000 : 0)));
      EXPECT_EQ(decodeWooden(report)->encoders[3], turned);
      wire.replies.push_back(report);
      (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
      EXPECT_EQ(sample.buttons, pressed ? 1U : 0U);
    }
  }
}

// by the makers' computeRotation, worked out by hand: a pen along x of what turns about the body
// (z), the fore arm (y), then the wrist (x, y, x); polhem_v1 has 1024 counts and signs - + -
TEST(WoodenDriver, APolhemTellsWhereItsPenPoints)
{
  struct Row
  {
    std::array<std::int16_t, 6> counts; // from the rest of the arm on: of c, -5000 is level
    Vector3d pen;                       // from its tip to its handle
  };
  const double half = std::sqrt(0.5);
  const std::array rows{ Row{ { 0, 0, -5000, 0, 0, 0 }, { 1, 0, 0 } },
    Row{ { 0, 0, -5000, 0, 0, 321 }, { 1, 0, 0 } },  // rolled in the fingers
    Row{ { 0, 0, -5000, 0, -256, 0 }, { 0, 0, 1 } }, // a quarter turn up
    Row{ { 0, 0, -5000, 0, -128, 77 }, { half, 0, half } },
    Row{ { 0, 0, -5000, 256, -256, 0 }, { 0, 1, 0 } },     // and over
    Row{ { -9000, 0, -5000, 0, 0, 0 }, { 0, 1, 0 } },      // the body, by 18 gears of 2000 counts
    Row{ { 0, 0, -2500, 0, 0, 0 }, { half, 0, -half } } }; // the fore arm hangs by half
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), *publishedArm("polhem"), 14);
  DriverSample sample;
  for (const auto& [counts, pen] : rows)
  {
    Packet report(14);
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      writeInt<std::int16_t>(report, 2 * i, counts[i]);
    }
    wire.replies.push_back(report);
    ASSERT_EQ(driver.tick(Vector3d::Zero(), 1.0_ms, sample), IoCode::Ok);
    const Vector3d axis = sample.orientation * -Vector3d::UnitZ();
    EXPECT_LT((axis + pen).norm(), 1e-9) << counts[0] << ' ' << counts[2] << ' ' << counts[4];
  }
}

TEST(WoodenDriver, AnArmWithoutAWristHoldsItsToolUpright)
{
  Wire wire;
  WoodenDriver driver(std::make_unique<MemoryTransport>(wire), WoodenArm{}, 14);
  DriverSample sample;
  Packet report = woodenReport(false);
  writeInt<std::int16_t>(report, 8, 500);
  wire.replies.push_back(report);
  (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
  EXPECT_EQ(sample.orientation.coeffs(), Eigen::Quaterniond::Identity().coeffs());
}

TEST(WoodenArm, TakesAWristFromItsText)
{
  const WoodenArm arm = parseWoodenArm("wrist = 1024 1024 4096\nwrist_sign = -1 1 -1\n", "a.txt");
  EXPECT_EQ(arm.wrist[2], 4096.0);
  EXPECT_EQ(arm.wristSign[1], 1.0);
  EXPECT_THROW((void)parseWoodenArm("wrist = -1 1024 1024\n", "a.txt"), Error);
  EXPECT_THROW((void)parseWoodenArm("wrist_sign = 2 1 1\n", "a.txt"), Error);
}

} // namespace
} // namespace palp
