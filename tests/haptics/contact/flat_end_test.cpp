#include "haptics/contact/find_contact.h"
#include "haptics/contact/overlap/flat_end.h"
#include "haptics/contact/overlap/overlap.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kFlat = 5.0_mm;
const Tip kPunch = PunchTip{ .radius = kFlat };

// side by side: floors from x to x at a height each
Surface floorsOf(const std::vector<Eigen::Vector3d>& floors)
{
  test::Mesh mesh;
  for (const Eigen::Vector3d& floor : floors)
  {
    const int first = static_cast<int>(mesh.first.size());
    for (const double x : { floor[0], floor[1] })
    {
      mesh.first.emplace_back(x, -40.0_mm, floor[2]);
      mesh.first.emplace_back(x, 40.0_mm, floor[2]);
    }
    mesh.second.push_back({ first, first + 2, first + 3 });
    mesh.second.push_back({ first, first + 3, first + 1 });
  }
  return test::makeSurface(mesh);
}

Contact pressed(const Surface& surface, const Eigen::Vector3d& apex, double lean = 0.0)
{
  const ToolPose pose{ .apex = apex,
    .axis = { std::sin(lean), 0.0, -std::cos(lean) },
    .velocity = Eigen::Vector3d::Zero() };
  return findContact(surface, kPunch, pose, ContactRule::Exact);
}

// of a spring that is pressed by the depth
Eigen::Vector3d springForce(const Contact& contact)
{
  return contact.depth * contact.slope * contact.normal;
}

// by springs below each part of the flat: the second floor adds from nothing on
TEST(FlatEnd, OverAStepIsHeldByEachFloorAsFarAsItIsPressed)
{
  for (const double step : { 0.3_mm, 1.0_mm, 2.5_mm })
  {
    const Surface floors = floorsOf({ { -40.0_mm, 0.0, 0.0 }, { 0.0, 40.0_mm, -step } });
    for (double depth = 0.1_mm; depth < 4.0_mm; depth += 0.1_mm)
    {
      for (const double part : { 0.5, 0.25 }) // of the radius that the upper floor reaches past
      {
        const double line = 1.0 - 2.0 * part; // from the middle, by the radius
        const double upper =
          (std::acos(line) - line * std::sqrt(1.0 - line * line)) / std::numbers::pi;
        const double lower = std::max(0.0, depth - step);
        const double squares = upper * depth * depth + (1.0 - upper) * lower * lower;
        const Contact contact = pressed(floors, { line * kFlat, 0.7_mm, -depth });
        EXPECT_NEAR(contact.depth, std::sqrt(squares), 3e-3 * depth) << step << " " << depth;
        EXPECT_NEAR(springForce(contact).z(), upper * depth + (1.0 - upper) * lower, 3e-3 * depth)
          << step << " " << depth;
      }
    }
  }
}

// whatever of a flank the rim reaches comes in from nothing: nothing leaps, or pulls
TEST(FlatEnd, InAValleyIsPushedSmoothlyOut)
{
  constexpr double kStep = 0.01_mm;
  for (const double flank : { 3.0_deg, 14.0_deg, 30.0_deg, 50.0_deg })
  {
    const double rise = 40.0_mm * std::tan(flank);
    const Surface valley = test::makeSurface(
      { { { -40.0_mm, -40.0_mm, rise }, { -40.0_mm, 40.0_mm, rise }, { 0.0, -40.0_mm, 0.0 },
          { 0.0, 40.0_mm, 0.0 }, { 40.0_mm, -40.0_mm, rise }, { 40.0_mm, 40.0_mm, rise } },
        { { 0, 2, 3 }, { 0, 3, 1 }, { 2, 4, 5 }, { 2, 5, 3 } } });
    for (const double x : { -8.0_mm, -4.0_mm, -1.0_mm, 0.0, 2.5_mm })
    {
      const double top = (kFlat + std::abs(x)) * std::tan(flank); // where the rim touches
      Eigen::Vector3d last = Eigen::Vector3d::Zero();
      for (double depth = 0.0; depth < 4.0_mm; depth += kStep)
      {
        const Eigen::Vector3d force = springForce(pressed(valley, { x, 0.3_mm, top - depth }));
        EXPECT_LT((force - last).norm(), 3.0 * kStep / std::cos(flank)) << flank << " " << depth;
        EXPECT_GE(force.z(), last.z() - 0.1 * kStep) << flank << " " << depth;
        last = force;
      }
    }
  }
}

// the force on a flat that leans is that of its mean depth, also where it is partly out
TEST(FlatEnd, ThatLeansIsPushedByItsMeanDepth)
{
  const Surface plane = floorsOf({ { -40.0_mm, 40.0_mm, 0.0 } });
  for (const double lean : { 1.0_deg, 5.0_deg, 12.0_deg, 25.0_deg, 40.0_deg })
  {
    for (double depth = -3.0_mm; depth < 4.0_mm; depth += 0.17_mm)
    {
      constexpr int kCells = 400; // of the flat, along the lean
      double mean = 0.0;
      for (int i = 0; i < kCells; ++i)
      {
        const double x = -1.0 + 2.0 * (i + 0.5) / kCells;
        const double chord = 2.0 * std::sqrt(1.0 - x * x) * 2.0 / kCells / std::numbers::pi;
        mean += chord * std::max(0.0, depth / std::cos(lean) + x * kFlat * std::tan(lean));
      }
      const Contact contact = pressed(plane, { 1.0_mm, 2.0_mm, -depth }, lean);
      const double along =
        springForce(contact).dot(Eigen::Vector3d(-std::sin(lean), 0.0, std::cos(lean)));
      EXPECT_NEAR(along, mean, 3e-3 * mean + 1e-7) << lean << " " << depth;
    }
  }
}

TEST(FlatEnd, LiftChangesAsItsAreaSays)
{
  const Surface block = test::makeSurface(test::block({ 60.0_mm, 60.0_mm, 30.0_mm }, 16));
  const Surface sheet = test::makeSurface(
    test::sheet(60.0_mm, 30, [](double x, double y) { return 3.0 * x * x - 2.0 * x * y; }));
  const ToolSolid solid(kPunch);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kStep = 1e-8;
  for (int i = 0; i < 300; ++i)
  {
    const Surface& surface = i % 2 == 0 ? block : sheet;
    const Eigen::Vector3d axis(0.4 * unit(random), 0.4 * unit(random), -1.0);
    ToolPose pose{ .apex = { 33.0_mm * unit(random), 33.0_mm * unit(random),
                     4.0_mm * unit(random) },
      .axis = axis.normalized(),
      .velocity = Eigen::Vector3d::Zero() };
    const Overlap here = overlapOf(surface, solid, ToolFrame(pose));
    const Eigen::Matrix3d axes = ToolFrame(pose).axes;
    for (Eigen::Index k = 0; k < 3; ++k)
    {
      const Eigen::Vector3d move = kStep * Eigen::Vector3d::Unit(k);
      ToolPose after = pose;
      after.apex += move;
      const Overlap there = overlapOf(surface, solid, ToolFrame(after));
      after.apex -= 2.0 * move;
      const Overlap before = overlapOf(surface, solid, ToolFrame(after));
      EXPECT_NEAR((there.lift - before.lift) / (2.0 * kStep), -(axes * here.liftArea)[k], 1e-12);
    }
  }
}

// by integrals over the ball's rings
TEST(FlatEnd, InABallIsThatOfItsTopAndInAHollowThatOfItsMiddle)
{
  for (const double radius : { 20.0_mm, 50.0_mm, -60.0_mm })
  {
    const double rise = 0.5 * kFlat * kFlat / radius;
    for (const double depth : { 0.02_mm, 0.2_mm, 0.6_mm, 1.5_mm, 4.0_mm })
    {
      double lift = 0.0;
      constexpr int kRings = 20'000;
      for (int i = 0; i < kRings; ++i)
      {
        const double r = kFlat * (i + 0.5) / kRings;
        const double ring = 2.0 * std::numbers::pi * r * kFlat / kRings;
        const double over = std::max(0.0, depth - rise * r * r / (kFlat * kFlat));
        lift += 0.5 * ring * over * over;
      }
      const Immersion there = flatImmersionOf(kFlat, lift, 1.0 / radius);
      EXPECT_NEAR(there.depth, depth, 1e-5 * depth) << radius;
    }
  }
}

TEST(FlatEnd, DepthChangesAsItsSlopesSay)
{
  for (const double curvature : { -15.0, 0.0, 1e-9, 12.0, 60.0 })
  {
    for (const double lift : { 1e-15, 2e-13, 5e-11 })
    {
      const Immersion here = flatImmersionOf(kFlat, lift, curvature);
      constexpr double step = 1e-6;
      const auto slope = [&](double l, double k)
      {
        const auto at = [&](double part)
        {
          return flatImmersionOf(kFlat, lift * (1.0 + part * l * step), curvature + part * k * step)
            .depth;
        };
        return (at(1.0) - at(-1.0)) / (2.0 * step);
      };
      EXPECT_NEAR(slope(1.0, 0.0), lift * here.byLift, 1e-6 * std::abs(here.depth) + 1e-12);
      EXPECT_NEAR(slope(0.0, 1.0), here.byCurvature, 1e-5 * kFlat * kFlat);
    }
  }
}

} // namespace
} // namespace palp
