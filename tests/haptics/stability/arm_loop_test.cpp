#include "haptics/stability/arm_grid.h"
#include "haptics/stability/arm_loop.h"

#include "haptics/units.h"
#include "tests/support/sampled.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInf = std::numeric_limits<double>::infinity();

std::function<Response(double)> rigid()
{
  return [](double depth)
  { return depth > 0.0 ? Response{ .force = kInf, .stiffness = kInf } : Response{}; };
}

std::function<Response(double)> nothing()
{
  return [](double) { return Response{}; };
}

// in free space: x(t) = F / b (t - m / b (1 - exp(-b t / m))), with Coulomb friction off the push
TEST(ArmLoop, MovesInFreeSpaceAsTheEquationSays)
{
  for (const double friction : { 0.0, 0.2 })
  {
    ArmCase arm{ .mass = 0.2,
      .damping = 0.5,
      .friction = friction,
      .startSpeed = 0.0,
      .duration = 0.05,
      .law = nothing() };
    const ArmResult result = simulateArm(arm);
    const double push = arm.handForce - friction;
    const double glide = arm.mass / arm.damping;
    const double travel =
      push / arm.damping * (arm.duration - glide * -std::expm1(-arm.duration / glide));
    EXPECT_NEAR(result.endDepth, travel - 5.0_mm, 0.01 * travel) << friction;
    EXPECT_EQ(result.peakForce, 0.0);
  }
}

TEST(ArmLoop, FrictionHoldsAHandThatIsWeaker)
{
  const ArmCase arm{ .friction = 1.5, .startSpeed = 0.0, .duration = 1.0, .law = nothing() };
  EXPECT_NEAR(simulateArm(arm).endDepth, -5.0_mm, 1e-12);
}

TEST(ArmLoop, TheObservedEnergyIsThatOfTheArmWhereItsDelayIsTold)
{
  for (const double delay : { 0.0_ms, 0.7_ms, 1.0_ms, 2.5_ms, 5.0_ms })
  {
    for (const double rate : { 400.0, 1000.0 })
    {
      const ArmCase arm{
        .damping = 0.5, .delay = delay, .statedDelay = delay, .period = 1.0 / rate, .law = rigid()
      };
      const ArmResult result = simulateArm(arm);
      EXPECT_LE(result.worstObserved, 1e-4) << delay << " " << rate;
      EXPECT_LE(std::abs(result.observedEnd - result.portEnd), 1e-4);
    }
  }
}

// told too little or too much by 3 ms
TEST(ArmLoop, ADelayThatIsMisstatedMakesNoLimitCycle)
{
  test::Sampled samples;
  for (const double mass : { 0.05, 0.1, 0.3 })
  {
    for (const double damping : { 0.2, 0.5 })
    {
      for (const double quantum : { 0.0, 48.0_um })
      {
        for (const auto& [real, told] : { std::pair{ 3.0_ms, 0.0_ms }, std::pair{ 4.0_ms, 1.0_ms },
               std::pair{ 0.0_ms, 3.0_ms }, std::pair{ 1.0_ms, 4.0_ms } })
        {
          if (!samples.takes())
          {
            continue;
          }
          const ArmCase arm{ .mass = mass,
            .damping = damping,
            .quantum = quantum,
            .delay = real,
            .statedDelay = told,
            .duration = 20.0,
            .law = rigid() };
          EXPECT_LE(simulateArm(arm).lateSpeed, 0.005)
            << mass << " kg, " << damping << " N s/m, " << quantum << " m, " << real
            << " s told as " << told;
        }
      }
    }
  }
}

// it was promised a hand, and it is let go
TEST(ArmLoop, AHandThatLetsGoLeavesNoLimitCycle)
{
  for (const double delay : { 0.6_ms, 1.5_ms, 3.0_ms })
  {
    const ArmCase arm{ .quantum = 48.0_um,
      .delay = delay,
      .statedDelay = delay,
      .statedHand = kGripDamping,
      .handForce = 0.5,
      .duration = 20.0,
      .law = rigid() };
    EXPECT_LE(simulateArm(arm).lateSpeed, 0.005) << delay;
  }
}

// a tool that moves more than the hand, or less: the hand does not tremble, held or let go
TEST(ArmLoop, AMotionThatIsScaledMakesNoLimitCycle)
{
  test::Sampled samples;
  for (const double scale : { 0.2, 2.0, 5.0 })
  {
    for (const double mass : { 0.05, 0.3 })
    {
      for (const double damping : { 0.2, 1.0 })
      {
        for (const auto& [real, told] :
          { std::pair{ 0.6_ms, 0.6_ms }, std::pair{ 3.0_ms, 0.0_ms } })
        {
          for (const ArmWorld world : { ArmWorld::Plane, ArmWorld::Workspace })
          {
            if (!samples.takes())
            {
              continue;
            }
            const ArmCase arm{ .mass = mass,
              .damping = damping,
              .quantum = 48.0_um,
              .delay = real,
              .statedDelay = told,
              .statedHand = kGripDamping,
              .scale = scale,
              .duration = 20.0,
              .world = world,
              .law = world == ArmWorld::Plane ? rigid() : nothing() };
            const ArmResult result = simulateArm(arm);
            EXPECT_LE(result.lateSpeed / scale, 0.005)
              << scale << ", " << mass << " kg, " << damping << " N s/m, " << real << " s";
            EXPECT_GT(result.peakForce, 0.4);
          }
        }
      }
    }
  }
}

TEST(ArmLoop, TheEndOfTheWorkspaceHoldsAnArm)
{
  for (const double delay : { 0.0_ms, 3.0_ms, 5.0_ms })
  {
    const ArmCase arm{ .quantum = 48.0_um,
      .delay = delay,
      .statedDelay = 0.0,
      .duration = 20.0,
      .world = ArmWorld::Workspace,
      .law = nothing() };
    const ArmResult result = simulateArm(arm);
    EXPECT_GT(result.peakForce, 0.5);
    EXPECT_LE(result.lateSpeed, 0.005) << delay;
  }
}

TEST(ArmGrid, CoversTheRangesAndHoldsThemAll)
{
  const std::vector<StabilityCase> cases = armCases(120);
  std::set<std::string> names;
  int bare = 0;
  int refused = 0;
  test::Sampled samples;
  for (const StabilityCase& one : cases)
  {
    names.insert(one.name);
    if (!samples.takes())
    {
      continue;
    }
    const StabilityRow row = judgeArm(*one.arm, true);
    EXPECT_NE(row.outcome, StabilityOutcome::Unstable) << one.name;
    refused += row.outcome == StabilityOutcome::Refused ? 1 : 0;
    bare += judgeArm(*one.arm, false).outcome == StabilityOutcome::Unstable ? 1 : 0;
  }
  EXPECT_EQ(names.size(), 3U);
  EXPECT_GE(bare, test::kSanitized ? 1 : 40);
  EXPECT_LE(refused, 6);
  const auto range = [&](double ArmCase::*quantity)
  {
    const auto [low, high] = std::ranges::minmax_element(
      cases, {}, [&](const StabilityCase& one) { return (*one.arm).*quantity; });
    return std::pair{ (*low->arm).*quantity, (*high->arm).*quantity };
  };
  EXPECT_EQ(range(&ArmCase::damping), (std::pair{ 0.05, 2.0 }));
  EXPECT_EQ(range(&ArmCase::mass), (std::pair{ 0.05, 1.0 }));
  EXPECT_EQ(range(&ArmCase::delay), (std::pair{ 0.0, 5.0_ms }));
  EXPECT_EQ(range(&ArmCase::quantum), (std::pair{ 0.0, 100.0_um }));
  EXPECT_EQ(range(&ArmCase::friction), (std::pair{ 0.0, 0.5 }));
  EXPECT_EQ(range(&ArmCase::handStiffness), (std::pair{ 0.0, 3000.0 }));
  EXPECT_EQ(range(&ArmCase::handDamping), (std::pair{ 0.0, 7.0 }));
  EXPECT_EQ(range(&ArmCase::period), (std::pair{ 1.0_ms, 1.0 / 300.0 }));
}

} // namespace
} // namespace palp
