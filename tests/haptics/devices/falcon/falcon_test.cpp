#include "haptics/devices/falcon/falcon.h"

#include "haptics/devices/falcon/falcon_kinematics.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

Bytes bytesOf(std::string_view text)
{
  return std::as_bytes(std::span(text));
}

std::string textOf(Bytes bytes)
{
  return { reinterpret_cast<const char*>(bytes.data()), bytes.size() };
}

TEST(FalconPacket, IdleIsTheOneOfThePublishedTraces)
{
  EXPECT_EQ(textOf(encode(FalconCommand{})), "<AAAAAAAAAAAAAA>");
}

TEST(FalconPacket, NibblesGoLeastSignificantFirst)
{
  // JFKP is 9 5 A F, so 0xFA59
  const FalconCommand command{ .torque = { -1447, 0, 0x123 }, .homing = true, .lights = 2 };
  EXPECT_EQ(textOf(encode(command)), "<JFKPAAAADCBADA>");
}

TEST(FalconPacket, TorquesAreClamped)
{
  const FalconCommand command{ .torque = { 32767, -32768, 4096 } };
  EXPECT_EQ(textOf(encode(command)), "<AAABAAAPAAABAA>"); // 0x1000, 0xF000, 0x1000
}

TEST(FalconReader, FindsAPacketHoweverItIsSplitOrJoined)
{
  const std::string stream = "zz<AAA"
                             "<JFKPAAAADCBAvA><AAAABAAAAAAAAA><A";
  for (std::size_t piece = 1; piece <= stream.size(); ++piece)
  {
    FalconReader reader;
    std::vector<FalconState> found;
    for (std::size_t i = 0; i < stream.size(); i += piece)
    {
      if (const auto state = reader.take(bytesOf(std::string_view(stream).substr(i, piece))))
      {
        found.push_back(*state);
      }
    }
    ASSERT_GE(found.size(), 1U) << piece;
    EXPECT_EQ(found.back().encoder[1], 1) << piece; // the newest one
    if (piece == 1)
    {
      ASSERT_EQ(found.size(), 2U);
      EXPECT_EQ(found[0].encoder[0], -1447);
      EXPECT_EQ(found[0].encoder[2], 0x123);
      EXPECT_EQ(found[0].buttons, 5); // v is 0x35 above A
      EXPECT_FALSE(found[0].homed);   // two axes of three
    }
  }
}

TEST(FalconReader, TakesWhatAnEncoderWouldSend)
{
  for (int value = -32768; value <= 32767; value += 97)
  {
    std::string packet = textOf(encode(FalconCommand{}));
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
    {
      packet[5 + nibble] = static_cast<char>('A' + ((value >> (4 * nibble)) & 0xF));
    }
    FalconReader reader;
    const auto state = reader.take(bytesOf(packet));
    ASSERT_TRUE(state);
    EXPECT_EQ(state->encoder[1], value);
  }
}

// heights on the axis, all legs at the same count
TEST(FalconKinematics, ReachesThePublishedHeights)
{
  const auto height = [](double counts)
  {
    const auto position =
      falconPosition(Vector3d::Constant(falconAngle(counts)), Vector3d(0.0, 0.0, 0.11));
    return position ? position->z() : -1.0;
  };
  EXPECT_NEAR(height(0.0), 0.1346, 5e-5);
  EXPECT_NEAR(height(-1500.0), 0.0741, 5e-5);
  EXPECT_NEAR(height(1000.0), 0.1736, 5e-5);
  EXPECT_EQ(height(1500.0), -1.0); // out of reach
}

Vector3d randomPosition(std::mt19937& random)
{
  std::uniform_real_distribution<double> aside(-0.03, 0.03);
  std::uniform_real_distribution<double> up(0.09, 0.16);
  const double x = aside(random);
  const double y = aside(random);
  return { x, y, up(random) };
}

TEST(FalconKinematics, PlaceAndAnglesAreInverse)
{
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const Vector3d position = randomPosition(random);
    const auto angles = falconAngles(position);
    ASSERT_TRUE(angles);
    const auto back = falconPosition(*angles, falconCenter());
    ASSERT_TRUE(back);
    EXPECT_LT((*falconAngles(*back) - *angles).norm(), 1e-9);
  }
}

// three equal legs, a third of a turn apart
TEST(FalconKinematics, AThirdOfATurnExchangesItsLegs)
{
  const Eigen::AngleAxisd third(-120.0_deg, Vector3d::UnitZ());
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i)
  {
    const Vector3d position = randomPosition(random);
    const auto here = falconAngles(position);
    const auto there = falconAngles(third * position);
    ASSERT_TRUE(here && there);
    EXPECT_NEAR((*there)[1], (*here)[0], 1e-9);
    EXPECT_NEAR((*there)[2], (*here)[1], 1e-9);
    EXPECT_NEAR((*there)[0], (*here)[2], 1e-9);
  }
}

// what the makers' driver sent for a force, in libnifalcon util/translate_packet.py: where the grip
// was is unknown, so that only the direction among the legs is compared
TEST(FalconKinematics, ItsLegsStandWhereThePublishedTracesHaveThem)
{
  struct Trace
  {
    Vector3d force;
    Vector3d counts;
  };
  const auto directionOf = [](const Vector3d& counts)
  {
    const double third = 120.0_deg;
    return std::atan2(counts[1] * std::sin(third) + counts[2] * std::sin(2.0 * third),
      counts[0] + counts[1] * std::cos(third) + counts[2] * std::cos(2.0 * third));
  };
  for (const auto& [force, counts] : { Trace{ Vector3d(0, -12.5, 0), Vector3d(-2900, 27, 929) },
         Trace{ Vector3d(-12.5, 0, 0), Vector3d(399, -3087, 1135) },
         Trace{ Vector3d(10.0, 0, 0), Vector3d(-679, 2529, -1862) } })
  {
    const double ours = directionOf(-*falconTorques(falconCenter(), force));
    EXPECT_LT(std::abs(std::remainder(ours - directionOf(counts), 360.0_deg)), 5.0_deg)
      << force.transpose();
  }
}

TEST(FalconKinematics, JacobianIsTheDerivative)
{
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i)
  {
    const Vector3d position = randomPosition(random);
    const auto jacobian = falconJacobian(position);
    ASSERT_TRUE(jacobian);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector3d step = 1e-5 * Vector3d::Unit(axis);
      const Vector3d slope =
        (*falconAngles(position + step) - *falconAngles(position - step)) / 2e-5;
      EXPECT_LT((jacobian->col(axis) - slope).norm(), 1e-6 * jacobian->norm());
    }
  }
}

// virtual work, with the motion from the angles and not from the Jacobian
TEST(FalconKinematics, TorquesDoTheWorkOfTheForce)
{
  const Vector3d position(0.01, -0.015, 0.12);
  const Vector3d force(1.0, -0.5, 2.0);
  const auto torques = falconTorques(position, force);
  ASSERT_TRUE(torques);
  const Vector3d change(1e-6, 2e-6, -3e-6);
  const Vector3d turned = *falconAngles(position + change) - *falconAngles(position - change);
  EXPECT_NEAR(torques->dot(turned), force.dot(2.0 * change), 1e-6 * force.norm() * change.norm());
}

TEST(FalconKinematics, SaysWhatIsOutOfReach)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector3d& position : { Vector3d(1.0, 0, 0.1), Vector3d(0, 0, 0.3),
         Vector3d(nan, 0, 0.1), Vector3d(0, 0.2, 0.1), Vector3d(0, 0, HUGE_VAL) })
  {
    EXPECT_FALSE(falconAngles(position));
    EXPECT_FALSE(falconTorques(position, Vector3d::UnitZ()));
  }
  EXPECT_FALSE(falconPosition(Vector3d::Constant(nan), falconCenter()));
}

} // namespace
} // namespace palp
