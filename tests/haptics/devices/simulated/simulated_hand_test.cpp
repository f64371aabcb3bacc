#include "haptics/devices/simulated/simulated_hand.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

const ToolPose kOrigin{};
const PressTarget kAside{ .position = Vector3d(0.0, 10.0_mm, 1.0_mm), .depth = 1.0_mm };

// a damped oscillator let go at rest, from a textbook
double textbook(const HandMechanics& hand, double from, double time)
{
  const double decay = hand.damping / (2.0 * hand.mass);
  const double frequency = std::sqrt(hand.stiffness / hand.mass - decay * decay);
  return from * std::exp(-decay * time) *
    (std::cos(frequency * time) + decay / frequency * std::sin(frequency * time));
}

TEST(SimulatedHand, MovesAsADampedOscillator)
{
  const HandMechanics mechanics;
  SimulatedHand hand(kOrigin, mechanics);
  hand.guided()->moveTo(kAside);
  const double tick = 0.1_ms;
  for (int i = 1; i <= 10000; ++i)
  {
    const double y = hand.exchange(Vector3d::Zero(), tick)->apex.y();
    // first-order method: the error is of the order of the tick times frequency
    ASSERT_NEAR(10.0_mm - y, textbook(mechanics, 10.0_mm, i * tick), 1e-3 * 10.0_mm) << i;
  }
}

TEST(SimulatedHand, ConvergesWithItsTick)
{
  const auto error = [](double tick)
  {
    SimulatedHand hand(kOrigin);
    hand.guided()->moveTo(kAside);
    double y = 0.0;
    for (int i = 0; i < static_cast<int>(std::lround(0.1 / tick)); ++i)
    {
      y = hand.exchange(Vector3d::Zero(), tick)->apex.y();
    }
    return std::abs(10.0_mm - y - textbook({}, 10.0_mm, 0.1));
  };
  EXPECT_NEAR(error(1.0_ms) / error(0.5_ms), 2.0, 0.1);
}

TEST(SimulatedHand, GivesWayToAForceByForceOverStiffness)
{
  SimulatedHand hand(kOrigin);
  ToolPose pose;
  for (int i = 0; i < 5000; ++i)
  {
    pose = *hand.exchange(Vector3d(0, 0, 2.0), 1.0_ms);
  }
  EXPECT_NEAR(pose.apex.z(), 2.0 / HandMechanics{}.stiffness, 1e-9);
  EXPECT_NEAR(pose.velocity.norm(), 0.0, 1e-9);
}

TEST(SimulatedHand, IsStableForAnyTick)
{
  for (const double tick : { 1e-6, 1.0_ms, 0.1, 10.0 })
  {
    SimulatedHand hand(kOrigin, { .mass = 0.001, .damping = 0.0, .stiffness = 1e6 });
    hand.guided()->moveTo(kAside);
    for (int i = 0; i < 1000; ++i)
    {
      ASSERT_LE(hand.exchange(Vector3d::Zero(), tick)->apex.norm(), 20.0_mm * 1.001) << tick;
    }
  }
}

TEST(SimulatedHand, StaysFiniteWhateverItIsGiven)
{
  SimulatedHand hand(kOrigin);
  hand.guided()->moveTo({ .position = Vector3d(kNoNumber, 0, 0) });
  hand.guided()->moveTo({ .normal = Vector3d(kNoNumber, 0, 0) });
  for (const double tick : { kNoNumber, -1.0, 0.0, HUGE_VAL })
  {
    EXPECT_TRUE(hand.exchange(Vector3d(kNoNumber, 0, 0), tick)->apex.allFinite());
    EXPECT_TRUE(hand.exchange(Vector3d(1, 1, 1), tick)->apex.allFinite());
  }
  EXPECT_EQ(hand.exchange(Vector3d(kNoNumber, 0, 0), 1.0_ms)->velocity, Vector3d::Zero());
}

TEST(SimulatedHand, RefusesMechanicsThatCannotBe)
{
  EXPECT_THROW(SimulatedHand(kOrigin, { .mass = 0.0 }), Error);
  EXPECT_THROW(SimulatedHand(kOrigin, { .damping = -1.0 }), Error);
  EXPECT_THROW(SimulatedHand(kOrigin, { .stiffness = kNoNumber }), Error);
  EXPECT_THROW(SimulatedHand({ .apex = Vector3d(kNoNumber, 0, 0) }), Error);
}

} // namespace
} // namespace palp
