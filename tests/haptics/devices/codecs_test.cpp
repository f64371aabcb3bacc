#include "haptics/devices/hid/phd1.h"
#include "haptics/devices/hid/spacemouse.h"
#include "haptics/devices/hid/wooden_haptics.h"

#include "haptics/devices/falcon/falcon.h"
#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/support/wooden_reference.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <string_view>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<std::byte> report(std::initializer_list<int> values)
{
  std::vector<std::byte> bytes;
  for (const int value : values)
  {
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

TEST(Crc16, HasThePublishedCheckValue)
{
  EXPECT_EQ(crc16(std::as_bytes(std::span(std::string_view("123456789")))), 0x29B1);
}

TEST(SpaceMouse, ReadsRecordedReports)
{
  SpaceMouseState state;
  EXPECT_TRUE(takeSpaceMouseReport(report({ 1, 0, 0, 0x5E, 1, 0xA2, 0xFE }), state));
  EXPECT_TRUE(takeSpaceMouseReport(report({ 2, 0, 0, 0xE2, 0xFF, 0, 0 }), state));
  EXPECT_TRUE(takeSpaceMouseReport(report({ 3, 1, 0 }), state));
  EXPECT_EQ(state.axes, (std::array<std::int16_t, 6>{ 0, 350, -350, 0, -30, 0 }));
  EXPECT_EQ(state.buttons, 1U);
  EXPECT_TRUE(takeSpaceMouseReport(report({ 1, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 6, 0 }), state));
  EXPECT_EQ(state.axes, (std::array<std::int16_t, 6>{ 1, 2, 3, 4, 5, 6 }));
}

TEST(SpaceMouse, LeavesTheStateAloneOnWhatIsNoReport)
{
  SpaceMouseState state;
  state.axes[0] = 7;
  for (const auto& bad : { report({}), report({ 1 }), report({ 1, 9, 9, 9, 9, 9 }),
         report({ 0x17, 90, 0, 0, 0, 0, 0 }), report({ 2, 1, 1, 1 }) })
  {
    EXPECT_FALSE(takeSpaceMouseReport(bad, state));
  }
  EXPECT_EQ(state.axes[0], 7);
}

TEST(SpaceMouse, SpeedIsZeroInTheDeadBandAndFullAtTheEnd)
{
  const RateControl rate;
  SpaceMouseState state;
  state.axes = { 17, 0, 0, 0, 0, 0 };
  EXPECT_EQ(velocityOf(state, rate), Vector3d::Zero());
  state.axes = { 350, 350, -400, 0, 0, 0 };
  EXPECT_TRUE(velocityOf(state, rate).isApprox(Vector3d(rate.speed, -rate.speed, rate.speed)));
}

TEST(Phd1, StateSurvivesTheWire)
{
  Phd1State state{ .homed = true,
    .motorsOn = true,
    .sequence = 65535,
    .microseconds = 4000000000U,
    .position = Vector3d(12.345_mm, -99.999_mm, 0.0),
    .orientation = { 0.5, -0.5, 0.5, -0.5 },
    .buttons = 3,
    .temperature = 41 };
  const auto back = decodePhd1State(encode(state));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->homed && back->motorsOn && !back->stopped);
  EXPECT_EQ(back->sequence, 65535);
  EXPECT_EQ(back->microseconds, 4000000000U);
  EXPECT_LT((back->position - state.position).norm(), 1e-9);
  EXPECT_NEAR(back->orientation[1], -0.5, 1e-9);
  EXPECT_EQ(back->buttons, 3);
  EXPECT_EQ(back->temperature, 41);
}

// the table of the protocol's description, byte by byte
TEST(Phd1, CommandHasTheDescribedLayout)
{
  const auto wire = encode(Phd1Command{ .order = Phd1Order::Force,
    .sequence = 0x0201,
    .force = Vector3d(1.0, -1.0, 0.002),
    .damping = 0.5 });
  const auto expected = report({ 'P', 'H', 1, 1, 1, 2, 0xE8, 3, 0x18, 0xFC, 2, 0, 0xF4, 1 });
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), wire.begin()));
  EXPECT_EQ(readInt<std::uint16_t>(wire, 14), crc16(expected));
  const auto back = decodePhd1Command(wire);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->force.isApprox(Vector3d(1.0, -1.0, 0.002)));
}

TEST(Phd1, EveryFlippedBitIsNoticed)
{
  const auto good = encode(Phd1State{ .homed = true, .position = Vector3d(1.0_mm, 0, 0) });
  for (std::size_t bit = 0; bit < 35 * 8; ++bit)
  {
    auto bad = good;
    bad[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(decodePhd1State(bad)) << bit;
  }
}

TEST(Phd1, ForceIsShortenedNotTurned)
{
  const auto back = decodePhd1Command(
    encode(Phd1Command{ .order = Phd1Order::Force, .force = Vector3d(100.0, -50.0, 0.0) }));
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->force.isApprox(Vector3d(32.0, -16.0, 0.0)));
  const auto none = decodePhd1Command(encode(Phd1Command{ .force = Vector3d(kNaN, 0, 0) }));
  EXPECT_EQ(none->force, Vector3d::Zero());
}

TEST(WoodenHaptics, ReadsCountsAndWritesMilliamperes)
{
  const auto in = decodeWooden(report({ 1, 0, 0xFF, 0xFF, 2, 0, 0, 0, 0, 0, 0, 0, 1, 0 }));
  ASSERT_TRUE(in);
  EXPECT_EQ(in->encoders, (std::array<std::int16_t, 6>{ 1, -1, 2, 0, 0, 0 }));
  EXPECT_TRUE(in->calibrate);
  EXPECT_FALSE(decodeWooden(report({ 1, 0, 2 })));

  std::array<std::byte, 14> out{};
  encodeWooden({ 1.0, -0.5, 0.0012 }, out);
  const auto expected = report({ 0xE8, 3, 0x0C, 0xFE, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0 });
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), out.begin()));
}

TEST(WoodenHaptics, StandsWhereTheDrawingSays)
{
  const WoodenArm arm; // at rest: upper arm straight up, forearm straight out
  const Vector3d place = forwardKinematics(arm, jointAngles(arm, { 0, 0, 6000, 0, 0, 0 }));
  EXPECT_TRUE(place.isApprox(Vector3d(0.245 - 0.220, 0.0, 0.080 + 0.205 - 0.080), 1e-12));
  // a count of the second encoder is 54 um at the end of the upper arm
  const Vector3d angles = jointAngles(arm, { 0, 1, 0, 0, 0, 0 });
  EXPECT_NEAR(angles[1] * 0.205, 54.0_um, 0.5_um);
}

TEST(WoodenHaptics, JacobianIsTheDerivative)
{
  const WoodenArm arm;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> angle(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector3d angles(angle(random), angle(random), 1.5 + 0.5 * angle(random));
    const Eigen::Matrix3d jacobian = positionJacobian(arm, angles);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = 1e-5 * Vector3d::Unit(axis);
      const Vector3d slope =
        (forwardKinematics(arm, angles + step) - forwardKinematics(arm, angles - step)) / 2e-5;
      EXPECT_LT((jacobian.col(axis) - slope).norm(), 1e-6 * jacobian.norm());
    }
  }
}

// what the makers' numbers and geometry say of the currents on the wire
TEST(WoodenHaptics, ForceArrivesThroughTheWire)
{
  const WoodenArm arm;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> fraction(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i)
  {
    const auto count = [&](double middle, double range)
    { return static_cast<std::int16_t>(middle + range * fraction(random)); };
    const std::array<std::int16_t, 6> counts{ count(0, 2000), count(760, 1140), count(5300, 1140),
      0, 0, 0 };
    const test::WoodenCounts at{ counts[0], counts[1], counts[2] };
    const Vector3d angles = jointAngles(arm, counts);
    EXPECT_LT((forwardKinematics(arm, angles) - test::woodenTool(at)).norm(), 1e-9);
    const Vector3d force =
      3.0 * Vector3d(fraction(random), fraction(random), fraction(random)).normalized();
    std::array<std::byte, 14> wire{};
    encodeWooden(motorCurrents(arm, angles, force).currents, wire);
    const auto current = [&](std::size_t motor) { return readInt<std::int16_t>(wire, 2 * motor); };
    const Vector3d felt = test::woodenForce(at, { current(0), current(1), current(2) });
    // a larger force than the motors bear is shorter but has the same direction
    EXPECT_LT(std::acos(std::min(1.0, felt.normalized().dot(force.normalized()))), 0.5_deg);
    EXPECT_LE(felt.norm(), 3.0 * 1.01);
    const auto currents = motorCurrents(arm, angles, force).currents;
    if (std::max({ std::abs(currents[0]), std::abs(currents[1]), std::abs(currents[2]) }) < 1.99)
    {
      EXPECT_NEAR(felt.norm(), 3.0, 0.01 * 3.0);
    }
  }
}

TEST(WoodenHaptics, CurrentsAreBoundedAndFinite)
{
  const WoodenArm arm;
  for (const Vector3d& force :
    { Vector3d(1e6, 0, 0), Vector3d(kNaN, 0, 0), Vector3d(0, HUGE_VAL, 0) })
  {
    for (const double current : motorCurrents(arm, Vector3d(0.1, 0.2, 1.4), force).currents)
    {
      EXPECT_LE(std::abs(current), arm.maxCurrent);
    }
  }
}

// calibrate_enc and workspace_origin of each, typed again: where it is calibrated the upper arm of
// WoodenHaptics stands upright and its forearm level
TEST(WoodenHaptics, PublishedArmsStandAtTheirRestWhereTheMakersSay)
{
  const auto restOf = [](const char* name)
  {
    const WoodenArm arm = *publishedArm(name);
    std::array<std::int16_t, 6> counts{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      counts[i] = static_cast<std::int16_t>(arm.rest[i]);
    }
    return forwardKinematics(arm, jointAngles(arm, counts));
  };
  EXPECT_TRUE(restOf("v2015").isApprox(Vector3d(0.245 - 0.220, 0.0, 0.205), 1e-9));
  EXPECT_TRUE(restOf("v2019").isApprox(Vector3d(0.245 - 0.220, 0.0, 0.205), 1e-9));
  EXPECT_TRUE(restOf("polhem").isApprox(Vector3d(0.133 - 0.140, 0.0, 0.058 + 0.174 - 0.100), 1e-9));
  EXPECT_TRUE(restOf("aluhaptics").isApprox(Vector3d(-0.140, 0.0, 0.111 + 0.140 - 0.111), 1e-9));
  EXPECT_FALSE(publishedArm("v2016"));
}

// with the upper arm upright and the forearm level a newton along y, x and z is each for one motor,
// by the makers' lengths, gears, constants and signs
TEST(WoodenHaptics, PublishedArmsPushWithTheirOwnMotors)
{
  struct Case
  {
    const char* name;
    double upper, forearm;
    std::array<double, 3> gear, constant;
    double sign;
  };
  for (const auto& [name, upper, forearm, gear, constant, sign] :
    { Case{ "v2015", 0.205, 0.245, { 16.0, 12.0, 12.0 }, { 0.0259, 0.0259, 0.0259 }, 1.0 },
      Case{ "v2019", 0.205, 0.245, { 16.0, 12.0, 12.0 }, { 0.321, 0.0603, 0.0603 }, 1.0 },
      Case{ "polhem", 0.174, 0.133, { 18.0, 10.0, 10.0 }, { 0.0538, 0.0538, 0.0538 }, -1.0 },
      Case{ "aluhaptics", 0.140, 0.111, { 0.116 / 0.0138, 0.076 / 0.0098, 0.076 / 0.0098 },
        { 0.0259, 0.0259, 0.0259 }, 1.0 } })
  {
    const WoodenArm arm = *publishedArm(name);
    const Vector3d angles(0.0, 0.0, std::numbers::pi / 2);
    const auto along = [&](double x, double y, double z)
    { return motorCurrents(arm, angles, 0.1 * Vector3d(x, y, z)).currents; };
    EXPECT_NEAR(along(0, 1, 0)[0], 0.1 * sign * forearm / gear[0] / constant[0], 1e-9) << name;
    EXPECT_NEAR(along(1, 0, 0)[1], 0.1 * sign * upper / gear[1] / constant[1], 1e-9) << name;
    EXPECT_NEAR(along(0, 0, 1)[2], 0.1 * sign * forearm / gear[2] / constant[2], 1e-9) << name;
    EXPECT_NEAR(along(0, 0, 1)[0], 0.0, 1e-9);
  }
}

// nothing that comes in can do more than be refused: run it under AddressSanitizer
TEST(Codecs, BearWhateverComesIn)
{
  std::mt19937_64 random(5);
  FalconReader falcon;
  SpaceMouseState mouse;
  std::vector<std::byte> wire;
  for (int i = 0; i < 1'000'000; ++i)
  {
    wire.resize(random() % 80);
    for (std::byte& byte : wire)
    {
      byte = static_cast<std::byte>(random());
    }
    if (i % 2 == 0 && wire.size() > 35) // past the first checks
    {
      wire[0] = std::byte{ 'P' };
      wire[1] = std::byte{ 'H' };
      wire[2] = std::byte{ 1 };
      const std::size_t crcAt = i % 4 == 0 ? 33 : 14;
      writeInt(MutableBytes(wire), crcAt, crc16(Bytes(wire).first(crcAt)));
    }
    if (i % 3 == 0 && !wire.empty())
    {
      wire[0] = static_cast<std::byte>(random() % 4);
    }
    if (const auto state = decodePhd1State(wire))
    {
      ASSERT_TRUE(state->position.allFinite());
      ASSERT_NEAR(std::hypot(std::hypot(state->orientation[0], state->orientation[1]),
                    std::hypot(state->orientation[2], state->orientation[3])),
        1.0, 1e-9);
    }
    if (const auto command = decodePhd1Command(wire))
    {
      ASSERT_LE(command->force.cwiseAbs().maxCoeff(), 32.768);
    }
    (void)takeSpaceMouseReport(wire, mouse);
    ASSERT_LE(velocityOf(mouse, {}).cwiseAbs().maxCoeff(), RateControl{}.speed);
    (void)decodeWooden(wire);
    (void)falcon.take(wire);
  }
}

} // namespace
} // namespace palp
