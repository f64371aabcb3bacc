#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/embed_stiffness.h"
#include "haptics/error.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/haptics/servo/work_over.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;
using test::workOver;

constexpr double kYoung = 50.0_kPa;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ForceLaw corrected(double young = kYoung, LawSettings settings = {})
{
  settings.mode = LawMode::Corrected;
  settings.constitution = ConstitutiveModel::Linear;
  return { SphereTip{ .radius = 10.0_mm }, makeMaterial(young, 0.45), settings };
}

Scene sceneOf(Surface surface, const ModulusAt& modulus, const ForceLaw& law = corrected())
{
  Scene world;
  world.surface = std::make_shared<const Surface>(std::move(surface));
  world.law = law;
  world.forceLimit = 1e3;
  world.stiffness = embedStiffness(*world.surface, world.law, modulus);
  return world;
}

// 40 mm thick, its upper face at z = 0
Surface blockOf(int cells = 8)
{
  return test::makeSurface(test::block({ 0.16, 0.16, 0.04 }, cells));
}

// the same with half the width, for what any body shows: a map of it takes a third of the time
Surface smallBlock()
{
  return test::makeSurface(test::block({ 0.08, 0.08, 0.04 }, 4));
}

ToolPose pressedAt(
  const Eigen::Vector3d& apex, const Eigen::Vector3d& axis = -Eigen::Vector3d::UnitZ())
{
  return { .apex = apex, .axis = axis };
}

double stiffInAColumn(const Eigen::Vector3d& x)
{
  return kYoung * (x.head<2>().norm() < 6.0_mm ? 2.0 : 1.0);
}

// from one side to the other, to twice as stiff
double stiffToOneSide(const Eigen::Vector3d& x)
{
  return kYoung * (1.5 + 0.5 * std::tanh(x.x() / 10.0_mm));
}

// rows A, B and D of data/reference/maps_axisym.csv, linear finite elements
TEST(StiffnessScene, ToolFeelsTheForceOfFiniteElements)
{
  const Scene skin = sceneOf(
    blockOf(), [](const Eigen::Vector3d& x) { return kYoung * (x.z() > -2.0_mm ? 3.0 : 1.0); });
  const Scene deep = sceneOf(
    blockOf(), [](const Eigen::Vector3d& x) { return kYoung * (x.z() < -10.0_mm ? 3.0 : 1.0); });
  const Scene column = sceneOf(blockOf(), stiffInAColumn);
  const auto forceAt = [](const Scene& world, double depth) {
    return step(world, pressedAt({ 0.0, 0.0, -depth })).response.force;
  };
  EXPECT_NEAR(forceAt(skin, 2.0_mm), 0.937734, 0.05 * 0.937734);
  EXPECT_NEAR(forceAt(skin, 6.0_mm), 4.77326, 0.05 * 4.77326);
  EXPECT_NEAR(forceAt(deep, 2.0_mm), 1.0588, 0.05 * 1.0588);
  EXPECT_NEAR(forceAt(deep, 6.0_mm), 6.5971, 0.05 * 6.5971);
  EXPECT_NEAR(forceAt(column, 2.0_mm), 1.22661, 0.05 * 1.22661);
  EXPECT_NEAR(forceAt(column, 6.0_mm), 5.61812, 0.05 * 5.61812);
}

TEST(StiffnessScene, AnEvenMapIsThatOfItsModulusOnAnyBody)
{
  const Surface ball = test::makeSurface(test::ball(50.0_mm, 30));
  const Scene map = sceneOf(ball, [](const Eigen::Vector3d&) { return 8.0_kPa; });
  Scene plain = map;
  plain.law = corrected(8.0_kPa);
  plain.stiffness = nullptr;
  for (const double angle : { 0.0, 0.4, 1.3 })
  {
    const Eigen::Vector3d out(std::sin(angle), 0.0, std::cos(angle));
    const ToolPose pose = pressedAt(46.0_mm * out, -out);
    const Sample felt = step(map, pose);
    const Sample even = step(plain, pose);
    EXPECT_NEAR(felt.response.force, even.response.force, 1e-6);
    EXPECT_NEAR(felt.response.stiffness, even.response.stiffness, 1e-3);
    EXPECT_NEAR((felt.lateral - even.lateral).norm(), 0.0, 1e-6);
  }
}

TEST(StiffnessScene, ForceIsTheSlopeOfItsStiffness)
{
  const Scene world = sceneOf(smallBlock(), stiffToOneSide);
  constexpr double kStep = 1.0_um;
  for (double depth = 0.5_mm; depth < 9.0_mm; depth += 0.7_mm)
  {
    const auto force = [&](double deep) {
      return step(world, pressedAt({ 3.0_mm, 1.0_mm, -deep })).response.force;
    };
    const double slope = (force(depth + kStep) - force(depth - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(
      step(world, pressedAt({ 3.0_mm, 1.0_mm, -depth })).response.stiffness, slope, 0.01 * slope);
  }
}

double loopOfPressed(const Scene& world, double from, double to)
{
  const auto down = [&](double t) { return pressedAt({ from, 0.0, -5.0_mm * t }); };
  const auto along = [&](double t) { return pressedAt({ from + (to - from) * t, 0.0, -5.0_mm }); };
  const auto up = [&](double t) { return pressedAt({ to, 0.0, -5.0_mm * (1.0 - t) }); };
  const double pressed = workOver(world, 500, down);
  const double loop = pressed + workOver(world, 1000, along) + workOver(world, 500, up);
  return std::abs(loop) / pressed;
}

TEST(StiffnessScene, NoLoopOverABlockGivesEnergy)
{
  const Scene side = sceneOf(blockOf(), stiffToOneSide);
  EXPECT_LT(loopOfPressed(side, -20.0_mm, 20.0_mm), 0.01);
  EXPECT_LT(loopOfPressed(side, 20.0_mm, -20.0_mm), 0.01);
  const Scene column = sceneOf(blockOf(), stiffInAColumn);
  EXPECT_LT(loopOfPressed(column, -20.0_mm, 1.0_mm), 0.01);
  Scene without = side;
  without.stiffness = nullptr;
  EXPECT_LT(loopOfPressed(without, -20.0_mm, 20.0_mm), 1e-6) << "of the law";
}

// The tool's axis turns with the normal, and with it the apex about the ball's center, which does
// no work
TEST(StiffnessScene, NoLoopOverABallGivesEnergy)
{
  constexpr double kRadius = 50.0_mm;
  const Scene world = sceneOf(test::makeSurface(test::ball(kRadius, 40)),
    [](const Eigen::Vector3d& x) { return kYoung * (1.5 + 0.5 * std::tanh(x.x() / 15.0_mm)); });
  const auto pose = [](double angle, double depth)
  {
    const Eigen::Vector3d out(std::sin(angle), 0.0, std::cos(angle));
    return pressedAt((kRadius - depth) * out, -out);
  };
  const auto work = [&](int steps, const std::function<ToolPose(double)>& path)
  {
    double sum = 0.0;
    const auto center = [&](double t)
    { return Eigen::Vector3d(path(t).apex - 10.0_mm * path(t).axis); };
    for (int i = 0; i < steps; ++i)
    {
      sum -= step(world, path((i + 0.5) / steps))
               .force.dot(center((i + 1.0) / steps) - center(static_cast<double>(i) / steps));
    }
    return sum;
  };
  const double pressed = work(400, [&](double t) { return pose(-0.4, 4.0_mm * t); });
  const double loop = pressed + work(1000, [&](double t) { return pose(-0.4 + 0.8 * t, 4.0_mm); }) +
    work(400, [&](double t) { return pose(0.4, 4.0_mm * (1.0 - t)); });
  EXPECT_LT(std::abs(loop), 0.01 * pressed);
  RecordProperty("loop_of_pressed", std::to_string(loop / pressed));
}

TEST(StiffnessScene, NoForceJumps)
{
  const Scene world = sceneOf(blockOf(), stiffInAColumn);
  constexpr double kStep = 1.0_um;
  Sample before = step(world, pressedAt({ -9.0_mm, 0.3_mm, -4.0_mm }));
  for (double x = -9.0_mm + kStep; x < 9.0_mm; x += kStep)
  {
    const Sample now = step(world, pressedAt({ x, 0.3_mm, -4.0_mm }));
    const double most = 1.05 * now.response.stiffness * kStep + 1e-6;
    ASSERT_LT((now.force - before.force).norm(), most) << x;
    before = now;
  }
}

// a layer a thousand times softer or stiffer below: a number everywhere, on its border, too
TEST(StiffnessScene, IsANumberWhereItChangesAThousandfold)
{
  test::Sampled samples(2);
  for (const double ratio : { 1e-3, 1e3 })
  {
    if (!samples.takes())
    {
      continue;
    }
    const Scene world = sceneOf(smallBlock(),
      [&](const Eigen::Vector3d& x) { return kYoung * (x.z() < -14.0_mm ? ratio : 1.0); });
    for (const double depth : { 0.1_mm, 1.0_mm, 4.0_mm, 9.0_mm })
    {
      const double above = step(world, pressedAt({ 3.0_mm, 1.0_mm, -depth })).response.force;
      EXPECT_GT(above, 0.0) << ratio << ' ' << depth;
      for (double z = -38.0_mm; z < -2.0_mm; z += test::kSanitized ? 4.0_mm : 0.5_mm)
      {
        const Sample beside =
          step(world, pressedAt({ 40.0_mm - depth, 0.0, z }, -Eigen::Vector3d::UnitX()));
        EXPECT_TRUE(std::isfinite(beside.response.force) && beside.force.allFinite())
          << ratio << ' ' << depth << ' ' << z;
      }
    }
  }
}

TEST(StiffnessScene, IsFeltWithoutAllocation)
{
  const Scene world = sceneOf(smallBlock(), stiffToOneSide);
  const test::AllocationGuard guard;
  const Sample sample = step(world, pressedAt({ 0.0, 0.0, -4.0_mm }));
  EXPECT_EQ(guard.count(), 0);
  EXPECT_LT(sample.lateral.x(), -0.01) << "away from what is stiff";
}

TEST(StiffnessScene, SafetyChainSendsTheLateralForceToo)
{
  const Scene world = sceneOf(blockOf(), stiffToOneSide);
  SafetyChain chain({ .model = "none", .maxForce = 100.0, .damping = 5.0 });
  TissueMemory memory;
  Sample sample;
  for (int i = 0; i < 2000; ++i) // until it has started
  {
    const double deep = std::min(3.0_mm, (i - 200) * 0.004_mm);
    sample =
      step(world, memory, chain, pressedAt({ 0.0, 0.0, -deep }), {}, { .armed = true }, 0.001);
  }
  EXPECT_NEAR(sample.force.x(), sample.lateral.x(), 1e-6);
  EXPECT_LT(sample.force.x(), -0.01);
}

TEST(StiffnessScene, WhatIsNotKnownIsRefused)
{
  const Surface block = smallBlock();
  const auto refusal = [&](const ModulusAt& modulus, const ForceLaw& law) -> std::string
  {
    try
    {
      (void)embedStiffness(block, law, modulus);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  const auto elsewhere = [](const Eigen::Vector3d& x) { return x.x() > 0.5 ? kYoung : kNone; };
  EXPECT_TRUE(refusal(elsewhere, corrected()).starts_with("stiffness: nothing is known of it"));
  const auto negative = [](const Eigen::Vector3d& x) { return x.x() > 0.0 ? kYoung : -1.0; };
  EXPECT_TRUE(refusal(negative, corrected()).starts_with("stiffness: there are values of 0"));
  const ForceLaw paper(SphereTip{ .radius = 10.0_mm }, makeMaterial(kYoung, 0.45));
  EXPECT_TRUE(refusal(stiffInAColumn, paper).starts_with("nodules and maps of stiffness: only"));
  EXPECT_EQ(embedStiffness(block, corrected(), {}), nullptr);
}

} // namespace
} // namespace palp
