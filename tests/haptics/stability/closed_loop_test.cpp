#include "haptics/stability/closed_loop.h"

#include "haptics/units.h"
#include "tests/support/sampled.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

std::function<Response(double)> wall(double stiffness)
{
  return [stiffness](double depth)
  {
    return depth > 0.0 ? Response{ .force = stiffness * depth, .stiffness = stiffness }
                       : Response{};
  };
}

struct Worst
{
  int cases = 0;
  int active = 0;               // gave energy to the hand
  double energy = 0.0;          // least [J]
  double envelope = 0.0;        // late by early speed
  double limitCycleSpeed = 0.0; // [m/s]
  double peakStep = 0.0;        // [N]
};

// the 54 devices: mass, damping, virtual damping, delay
template <typename Make>
Worst overTheGrid(const Make& make)
{
  Worst worst;
  test::Sampled samples;
  for (const double mass : { 0.05, 0.1, 0.3 })
  {
    for (const double damping : { 0.5, 1.0, 2.0 })
    {
      for (const double virtualDamping : { 0.0, 2.0 })
      {
        for (const int delay : { 0, 1, 2 })
        {
          ++worst.cases;
          if (!samples.takes())
          {
            continue;
          }
          LoopCase loop;
          loop.plant.mass = mass;
          loop.plant.damping = damping;
          loop.plant.delay = delay;
          loop.damping = virtualDamping;
          make(loop, stableStiffness({ damping, virtualDamping, 1.0_ms, delay * 1.0_ms }));
          const LoopResult result = simulate(loop);
          worst.active += result.energy < -1e-6 ? 1 : 0;
          worst.energy = std::min(worst.energy, result.energy);
          worst.envelope =
            std::max(worst.envelope, result.limitCycleSpeed / std::max(result.earlySpeed, 1e-4));
          worst.limitCycleSpeed = std::max(worst.limitCycleSpeed, result.limitCycleSpeed);
          worst.peakStep = std::max(worst.peakStep, result.peakStep);
        }
      }
    }
  }
  return worst;
}

Worst bareWall(double fraction)
{
  return overTheGrid(
    [fraction](LoopCase& loop, double stable)
    {
      loop.plant.maxForce = 1e9;
      loop.law = wall(fraction * stable);
    });
}

TEST(ClosedLoop, BareWallBelowTheStableStiffnessGivesNoEnergy)
{
  for (const double fraction : { 0.7, 0.8 })
  {
    const Worst worst = bareWall(fraction);
    EXPECT_EQ(worst.cases, 54);
    EXPECT_GE(worst.energy, -1e-6) << fraction;
    EXPECT_LE(worst.envelope, 0.1) << fraction;
  }
}

TEST(ClosedLoop, BareWallAboveTheStableStiffnessGivesEnergy)
{
  EXPECT_GE(bareWall(1.3).active, test::kSanitized ? 1 : 15);
}

struct Wall
{
  double stiffness; // of the law [N/m]
  double quantum;   // of the encoder [m]
};

class ThroughTheChain : public ::testing::TestWithParam<Wall>
{
};
INSTANTIATE_TEST_SUITE_P(ClosedLoop, ThroughTheChain,
  ::testing::Values(
    Wall{ 34e3, 0.0 }, Wall{ 1e9, 0.0 }, Wall{ kInfinite, 0.0 }, Wall{ kInfinite, 48.0_um }));

TEST_P(ThroughTheChain, AnyStiffnessBehavesAsAWallThatTheDeviceCanRender)
{
  const Wall& told = GetParam();
  const Worst worst = overTheGrid(
    [&](LoopCase& loop, double)
    {
      loop.law = wall(told.stiffness);
      loop.plant.quantum = told.quantum;
      loop.chain = SafetySettings{};
    });
  EXPECT_GE(worst.energy, -1e-6);
  EXPECT_LE(worst.peakStep, 0.5 * (1.0 + 1e-9));
  EXPECT_LE(worst.limitCycleSpeed, 0.025);
  if (told.quantum == 0.0)
  {
    EXPECT_LE(worst.envelope, 0.1);
  }
}

// not only stable: the very motion of a wall as stiff as may be, until a
// limit of force or rate acts
TEST(ClosedLoop, AnyStiffnessMovesAsTheCappedWallDoes)
{
  for (const double stiffness : { 34e3, 1e9, kInfinite })
  {
    LoopCase loop;
    loop.plant.startSpeed = 0.05;
    loop.duration = 5.0;
    loop.law = wall(0.7 * 2.0 * loop.plant.damping / loop.period);
    const LoopResult bare = simulate(loop);
    loop.law = wall(stiffness);
    loop.forceLimit = loop.plant.maxForce;
    loop.chain = SafetySettings{ .passivityDamping = 0.0 };
    const LoopResult chained = simulate(loop);
    EXPECT_NEAR(chained.peakForce, bare.peakForce, 1e-9) << stiffness;
    EXPECT_NEAR(chained.endDepth, bare.endDepth, 1e-9) << stiffness;
    EXPECT_NEAR(chained.portEnd, bare.portEnd, 1e-9) << stiffness;
  }
}

// the delay of a tick or of an encoder makes an accelerator of a damper that is strong enough
TEST(ClosedLoop, NoVirtualDampingMakesTheHandHum)
{
  test::Sampled samples(7);
  for (const double damping : { 5.0, 20.0, 50.0 })
  {
    for (const double stiffness : { 350.0, 34e3, kInfinite })
    {
      for (const double quantum : { 0.0, 48.0_um })
      {
        for (const int delay : { 0, 1 })
        {
          if (!samples.takes())
          {
            continue;
          }
          LoopCase loop;
          loop.plant.mass = 0.05;
          loop.plant.damping = 0.2;
          loop.plant.quantum = quantum;
          loop.plant.delay = delay;
          loop.law = wall(stiffness);
          loop.damping = damping;
          loop.chain = SafetySettings{};
          const LoopResult result = simulate(loop);
          EXPECT_LE(result.limitCycleSpeed, 0.025) << damping << " N s/m, " << stiffness << " N/m, "
                                                   << quantum << " m, " << delay << " ticks";
        }
      }
    }
  }
}

TEST(ClosedLoop, SoftTissueComesThroughTheChainUnchanged)
{
  LoopCase loop;
  loop.law = [](double depth)
  {
    return depth > 0.0 ? Response{ .force = 7.48e3 * std::pow(depth, 1.5),
      .stiffness = 1.5 * 7.48e3 * std::sqrt(depth) }
                       : Response{};
  };
  loop.plant.startSpeed = 0.1; // stays below the largest force
  loop.duration = 5.0;
  const LoopResult bare = simulate(loop);
  loop.chain = SafetySettings{};
  const LoopResult chained = simulate(loop);
  EXPECT_NEAR(chained.peakForce, bare.peakForce, 1e-9 * bare.peakForce);
  EXPECT_NEAR(chained.endDepth, bare.endDepth, 1e-9);
  EXPECT_NEAR(chained.endForce, loop.plant.handForce, 1e-6);
}

TEST(ClosedLoop, LawSwappedInContactGivesNoEnergy)
{
  for (const double before : { 100.0, 600.0, 1200.0 })
  {
    for (const double after : { 50.0, 600.0, 1e9 })
    {
      LoopCase loop;
      loop.law = wall(before);
      loop.swapped = wall(after);
      loop.duration = 10.0;
      loop.chain = SafetySettings{};
      const LoopResult result = simulate(loop);
      EXPECT_GE(result.energy, -1e-6) << before << " to " << after;
      EXPECT_LE(result.peakStep, 0.5 * (1.0 + 1e-9));
      EXPECT_NEAR(result.endForce, loop.plant.handForce, 1e-3);
    }
  }
}

// the stiffness of the wall is then 1.4 times what is stable; without passivity control it is held
// by what finds a swing that does not die
TEST(ClosedLoop, ADeviceWithHalfItsStatedDampingComesToRestAtARigidWall)
{
  LoopCase loop;
  loop.law = wall(kInfinite);
  loop.plant.statedDamping = 2.0 * loop.plant.damping;
  loop.chain = SafetySettings{};
  LoopResult result = simulate(loop);
  EXPECT_GE(result.energy, -1e-6);
  EXPECT_LE(result.limitCycleSpeed, 1e-6);
  loop.chain->passivityDamping = 0.0;
  EXPECT_LE(simulate(loop).limitCycleSpeed, 0.005);
  loop.chain.reset();
  EXPECT_GE(simulate(loop).limitCycleSpeed, 0.1);
}

TEST(ClosedLoop, LostTicksGiveAtMostAMillijoule)
{
  for (const int lost : { 1, 2, 5, 20 })
  {
    LoopCase loop;
    loop.law = wall(1122.0); // 50 kPa under a sphere of 10 mm, 10 mm deep
    loop.dropped = lost;
    loop.duration = 10.0;
    loop.chain = SafetySettings{};
    const LoopResult result = simulate(loop);
    EXPECT_GE(result.energy, -1e-3) << lost;
    RecordProperty("least_energy_J", std::to_string(result.energy));
  }
}

TEST(ClosedLoop, StallsGiveNoEnergyHoweverDeepTheToolSank)
{
  for (const double stiffness : { 600.0, 1122.0, kInfinite })
  {
    LoopCase loop;
    loop.law = wall(stiffness);
    loop.dropped = 20;
    loop.dropEvery = 4.0;
    loop.chain = SafetySettings{};
    EXPECT_GE(simulate(loop).energy, -1e-6) << stiffness;
  }
}

} // namespace
} // namespace palp
