// What a driver says that it sent is what its device would do to a hand: each is read off the wire.

#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/identify/identified_driver.h"
#include "haptics/units.h"
#include "tests/haptics/devices/memory_transport.h"
#include "tests/support/wooden_reference.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;
using Eigen::Vector3d;

constexpr WoodenCounts kPlace{ 150, 764, 3667 };

// answers each command; calibrated by its first
struct Board : Wire
{
  Board()
  {
    hear = [this](Bytes)
    {
      Packet report(14);
      for (std::size_t i = 0; i < 3; ++i)
      {
        writeInt(report, 2 * i, static_cast<std::int16_t>(kPlace[i]));
      }
      writeInt<std::int16_t>(report, 12, heard.size() == 1 ? 1 : 0);
      replies.push_back(report);
    };
  }

  [[nodiscard]] Vector3d felt() const
  {
    const auto current = [&](std::size_t motor)
    { return readInt<std::int16_t>(heard.back(), 1 + 2 * motor); };
    const bool runs = readInt<std::int16_t>(heard.back(), 7) == 0;
    return runs ? woodenForce(kPlace, { current(0), current(1), current(2) })
                : Vector3d(Vector3d::Zero());
  }
};

TEST(SentForce, OfWoodenHapticsIsWhatItsCurrentsDo)
{
  Board board;
  WoodenDriver driver(std::make_unique<MemoryTransport>(board), WoodenArm{}, 14);
  const double rounding = woodenRounding(kPlace);
  DriverSample sample;
  double least = 1.0; // share of what was asked for
  for (int i = 0; i < 12'000; ++i)
  {
    // a force that is too large at once, then one that is too large for long
    const Vector3d force = i < 100 ? Vector3d(3.0, -9.0, 40.0) : Vector3d(1.0, -2.0, 5.0);
    ASSERT_EQ(driver.tick(force, 1.0_ms, sample), IoCode::Ok);
    ASSERT_TRUE(sample.sent);
    ASSERT_LE((*sample.sent - board.felt()).norm(), rounding) << i;
    if (i > 2)
    {
      ASSERT_LT(sample.sent->normalized().cross(force.normalized()).norm(), 1e-9);
      least = std::min(least, sample.sent->norm() / force.norm());
    }
    board.heard.resize(std::min<std::size_t>(board.heard.size(), 2));
  }
  EXPECT_LT(least, 0.5);
}

TEST(SentForce, IsToldAlsoWhereNothingCameBack)
{
  Board board;
  WoodenDriver driver(std::make_unique<MemoryTransport>(board), WoodenArm{}, 14);
  DriverSample sample;
  for (int i = 0; i < 5; ++i)
  {
    (void)driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample);
  }
  const Vector3d place = sample.position;
  board.silent = true;
  EXPECT_EQ(driver.tick(Vector3d(0, 0, 2), 1.0_ms, sample), IoCode::Timeout);
  EXPECT_NEAR(sample.sent->z(), 2.0, 0.01);
  EXPECT_LE((*sample.sent - board.felt()).norm(), woodenRounding(kPlace));
  EXPECT_EQ(sample.position, place);
  EXPECT_EQ(driver.tick(Vector3d(0, 0, std::nan("")), 1.0_ms, sample), IoCode::Timeout);
  EXPECT_EQ(*sample.sent, Vector3d::Zero());
}

// newtons of a hand that weighed the arm: half of those that its makers state
TEST(SentForce, OfAnArmThatWasWeighedIsInNewtonsOfTheHand)
{
  Board board;
  IdentifiedArm arm;
  arm.scale = 0.5;
  IdentifiedDriver driver(
    std::make_unique<WoodenDriver>(std::make_unique<MemoryTransport>(board), WoodenArm{}, 14), arm);
  DriverSample sample;
  for (int i = 0; i < 5; ++i)
  {
    (void)driver.tick(Vector3d(0, 0, 1), 1.0_ms, sample);
  }
  EXPECT_NEAR(sample.sent->z(), 1.0, 0.01);
  EXPECT_LE((*sample.sent - 0.5 * board.felt()).norm(), woodenRounding(kPlace));
}

// letters of a motor, the least significant first, A for 0
int falconCount(Bytes packet, std::size_t motor)
{
  unsigned word = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    word |= (std::to_integer<unsigned>(packet[1 + 4 * motor + i]) - 'A') << (4 * i);
  }
  return static_cast<std::int16_t>(word);
}

// by the work of a small motion: torques times the way of the legs is force times the way
Vector3d falconFelt(Bytes packet, const Vector3d& place)
{
  constexpr double kStep = 1e-6;            // [m]
  constexpr double kCountsPerTorque = 2300; // [1/(N m)]
  const Vector3d counts(falconCount(packet, 0), falconCount(packet, 1), falconCount(packet, 2));
  Vector3d felt;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    const Vector3d turned = *falconAngles(place + step) - *falconAngles(place - step);
    felt[axis] = -counts.dot(turned) / (2.0 * kStep) / kCountsPerTorque;
  }
  return felt;
}

TEST(SentForce, OfAFalconIsWhatItsMotorsDo)
{
  Wire wire;
  bool homed = false;
  wire.hear = [&](Bytes packet)
  {
    if (packet.size() == kFalconPacket)
    {
      Packet reply{ std::byte{ 1 }, std::byte{ 0x60 } };
      const Packet body = packetOf(encode(FalconCommand{ .torque = { 1000, 1000, 1000 } }));
      reply.insert(reply.end(), body.begin(), body.end());
      reply[2 + 13] = static_cast<std::byte>('A' + (homed ? 0x70 : 0));
      wire.replies.push_back(reply);
    }
  };
  FalconDriver driver(std::make_unique<MemoryTransport>(wire), {});
  DriverSample sample;
  (void)driver.tick(Vector3d(1, 2, 3), 1.0_ms, sample);
  EXPECT_EQ(*sample.sent, Vector3d::Zero());
  homed = true;
  (void)driver.tick(Vector3d::Zero(), 1.0_ms, sample);
  for (const double size : { 0.5, 3.0, 60.0, 1e3 })
  {
    const Vector3d force = size * Vector3d(0.6, 0.0, -0.8);
    ASSERT_EQ(driver.tick(force, 1.0_ms, sample), IoCode::Ok);
    const Vector3d felt = falconFelt(wire.heard.back(), sample.position + falconCenter());
    EXPECT_LT((*sample.sent - felt).norm(), 0.02) << size; // of whole counts
    EXPECT_LT(sample.sent->cross(force).norm(), 1e-9 * size * size);
    EXPECT_EQ(sample.sent->norm() < 0.9 * size, size > 50.0);
  }
}

TEST(SentForce, OfAPhd1BoardIsWhatStandsOnTheWire)
{
  Wire wire;
  Phd1Driver driver(std::make_unique<MemoryTransport>(wire));
  DriverSample sample;
  Phd1State state;
  for (const bool homed : { false, true })
  {
    state.homed = homed;
    for (const Vector3d& force : { Vector3d(1.23456, 0, -2), Vector3d(0, 50, 25) })
    {
      ++state.sequence;
      state.microseconds += 1000;
      wire.replies.push_back(packetOf(encode(state)));
      (void)driver.tick(force, 1.0_ms, sample);
      Vector3d told; // behind the report id: two letters, version, order, sequence [mN]
      for (std::size_t i = 0; i < 3; ++i)
      {
        told[static_cast<int>(i)] = 1e-3 * readInt<std::int16_t>(wire.heard.back(), 7 + 2 * i);
      }
      EXPECT_LT((*sample.sent - told).norm(), 1e-12);
      EXPECT_LE(sample.sent->norm(), 32.0 * std::sqrt(1.25) + 1e-9);
    }
  }
  EXPECT_NEAR(sample.sent->y(), 32.0, 1e-3); // a word of the wire holds no more
  EXPECT_NEAR(sample.sent->z(), 16.0, 1e-3);
}

} // namespace
} // namespace palp
