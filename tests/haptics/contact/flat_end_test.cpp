#include "haptics/contact/find_contact.h"
#include "haptics/contact/overlap/flat_end.h"
#include "haptics/contact/overlap/overlap.h"
#include "haptics/contact/overlap/section.h"
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
const std::vector<std::pair<const char*, Tip>> kFlats = {
  { "punch", kPunch },
  { "truncated cone",
    TruncatedConeTip{ .halfAngle = 45.0_deg, .flatRadius = 2.0_mm, .baseRadius = 8.0_mm } },
  { "slim truncated cone",
    TruncatedConeTip{ .halfAngle = 20.0_deg, .flatRadius = 3.0_mm, .baseRadius = 5.0_mm } },
  { "wide truncated cone",
    TruncatedConeTip{ .halfAngle = 60.0_deg, .flatRadius = 1.0_mm, .baseRadius = 10.0_mm } },
};

// of the circle of contact at a depth
double circleAt(const ToolSolid& solid, double depth)
{
  return std::sqrt(sectionOf(solid, Eigen::Vector3d::UnitZ(), depth).area / std::numbers::pi);
}

// of a half-space whose face leans, by discs
double liftBelow(const Tip& tip, double height, double lean)
{
  const ToolSolid solid(tip);
  constexpr int kDiscs = 4000;
  const double top = 2.0 * height + 4.0 * baseRadius(tip) * std::tan(lean);
  const double thick = std::max(0.0, top) / kDiscs;
  double lift = 0.0;
  for (int i = 0; i < kDiscs; ++i)
  {
    const double z = (i + 0.5) * thick;
    const double radius = circleAt(solid, z);
    const double line = (height / std::cos(lean) - z) / std::max(1e-9, std::tan(lean));
    const double part = std::clamp(line / radius, -1.0, 1.0);
    lift += z * thick * radius * radius *
      (std::numbers::pi - std::acos(part) + part * std::sqrt(1.0 - part * part));
  }
  return lift;
}

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

Contact pressed(
  const Surface& surface, const Eigen::Vector3d& apex, double lean = 0.0, const Tip& tip = kPunch)
{
  const ToolPose pose{ .apex = apex,
    .axis = { std::sin(lean), 0.0, -std::cos(lean) },
    .velocity = Eigen::Vector3d::Zero() };
  return findContact(surface, tip, pose, ContactRule::Exact);
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

// half of it over the upper floor, and half over the lower one
TEST(FlatEnd, OfAConeIsHeldByEachFloorAsFarAsItIsPressed)
{
  const double step = 1.0_mm;
  const Surface floors = floorsOf({ { -40.0_mm, 0.0, 0.0 }, { 0.0, 40.0_mm, -step } });
  for (const auto& [name, tip] : kFlats)
  {
    const auto lift = [&tip = tip](double depth)
    { return liftBelow(tip, std::max(0.0, depth), 0.0); };
    for (double depth = 0.2_mm; depth < 3.0_mm; depth += 0.2_mm)
    {
      const Contact contact = pressed(floors, { 0.0, 0.7_mm, -depth }, 0.0, tip);
      const double all = 0.5 * (lift(depth) + lift(depth - step));
      EXPECT_NEAR(lift(contact.depth), all, 2e-3 * all) << name << " " << depth;
      constexpr double kMove = 1e-6;
      const double before = pressed(floors, { 0.0, 0.7_mm, -depth + kMove }, 0.0, tip).depth;
      const double after = pressed(floors, { 0.0, 0.7_mm, -depth - kMove }, 0.0, tip).depth;
      EXPECT_NEAR(contact.slope * contact.normal.z(), (after - before) / (2.0 * kMove), 2e-3)
        << name << " " << depth;
    }
  }
}

// as the second floor comes level, whatever of the flat is over it
TEST(FlatEnd, NothingLeapsAsASecondFloorComesIn)
{
  constexpr double kStep = 0.001_mm;
  const double step = 0.5_mm;
  const Surface stairs = test::makeSurface(
    { { { -40.0_mm, -40.0_mm, 0.0 }, { -40.0_mm, 40.0_mm, 0.0 }, { 0.0, -40.0_mm, 0.0 },
        { 0.0, 40.0_mm, 0.0 }, { 0.0, -40.0_mm, -step }, { 0.0, 40.0_mm, -step },
        { 40.0_mm, -40.0_mm, -step }, { 40.0_mm, 40.0_mm, -step } },
      { { 0, 2, 3 }, { 0, 3, 1 }, { 2, 4, 5 }, { 2, 5, 3 }, { 4, 6, 7 }, { 4, 7, 5 } } });
  for (const auto& [name, tip] : kFlats)
  {
    for (const double part : { -0.9, -0.5, 0.0, 0.5, 0.9 })
    {
      const double x = part * flatRadius(tip);
      Eigen::Vector3d last = Eigen::Vector3d::Zero();
      for (double depth = step - 0.05_mm; depth < step + 0.05_mm; depth += kStep)
      {
        const Eigen::Vector3d force = springForce(pressed(stairs, { x, 0.3_mm, -depth }, 0.0, tip));
        if (last.norm() > 0.0)
        {
          EXPECT_LT((force - last).norm(), 4.0 * kStep) << name << " " << part << " " << depth;
        }
        last = force;
      }
    }
  }
}

TEST(FlatEnd, LiftOfAPlaneIsThatOfItsDiscs)
{
  const Surface plane = floorsOf({ { -80.0_mm, 80.0_mm, 0.0 } });
  for (const auto& [name, tip] : kFlats)
  {
    for (const double lean : { 0.0, 3.0_deg, 11.0_deg })
    {
      for (const double depth : { 0.1_mm, 0.8_mm, 2.5_mm, 4.0_mm })
      {
        const ToolPose pose{ .apex = { 0.4_mm, 0.3_mm, -depth },
          .axis = { std::sin(lean), 0.0, -std::cos(lean) },
          .velocity = Eigen::Vector3d::Zero() };
        const double lift = liftBelow(tip, depth, lean);
        const Overlap overlap = overlapOf(plane, ToolSolid(tip), ToolFrame(pose));
        EXPECT_NEAR(overlap.lift, lift, 2e-3 * lift) << name << " " << lean << " " << depth;
        if (lean == 0.0)
        {
          EXPECT_NEAR(flatImmersionOf(ToolSolid(tip), overlap.lift, 0.0).depth, depth, 1e-9);
        }
      }
    }
  }
}

// whatever of a flank the rim reaches comes in from nothing: nothing leaps, or pulls; none of these
// cones lies flush with a flank, which comes in as a whole
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
    for (const auto& [name, tip] : kFlats)
    {
      for (const double x : { -8.0_mm, -4.0_mm, -1.0_mm, 0.0, 2.5_mm })
      {
        // where the rim touches, or is about to
        const double top = (flatRadius(tip) + std::abs(x)) * std::tan(flank);
        Eigen::Vector3d last = springForce(pressed(valley, { x, 0.3_mm, top }, 0.0, tip));
        for (double depth = 0.0; depth < 4.0_mm; depth += kStep)
        {
          const Eigen::Vector3d force =
            springForce(pressed(valley, { x, 0.3_mm, top - depth }, 0.0, tip));
          EXPECT_LT((force - last).norm(), 3.1 * kStep / std::cos(flank))
            << name << " " << x << " " << flank << " " << depth;
          // a spring is stiffer the deeper; of a cone, the wider
          const double wider =
            ToolSolid(tip).radiusAt(depth).value / ToolSolid(tip).radiusAt(depth - kStep).value;
          EXPECT_GE(force.z(), last.z() / wider - 0.1 * kStep)
            << name << " " << flank << " " << depth;
          last = force;
        }
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
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kStep = 1e-8;
  for (int i = 0; i < 1200; ++i)
  {
    const Surface& surface = i / 2 % 2 == 0 ? block : sheet;
    const ToolSolid solid(kFlats[static_cast<std::size_t>(i) % kFlats.size()].second);
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

// by discs of what the tool and a paraboloid have in common
TEST(FlatEnd, InABallIsThatOfItsTopAndInAHollowThatOfItsMiddle)
{
  for (const auto& [name, tip] : kFlats)
  {
    const ToolSolid solid(tip);
    for (const double radius : { 20.0_mm, 50.0_mm, -60.0_mm })
    {
      for (const double depth : { 0.02_mm, 0.2_mm, 0.6_mm, 1.5_mm, 4.0_mm })
      {
        constexpr int kDiscs = 10'000;
        const double top = depth + std::max(0.0, -0.5 * std::pow(baseRadius(tip), 2) / radius);
        double lift = 0.0;
        for (int i = 0; i < kDiscs; ++i)
        {
          const double z = top * (i + 0.5) / kDiscs;
          const double own = std::pow(circleAt(solid, z), 2);
          const double body = 2.0 * radius * (depth - z);
          const double both = radius > 0.0 ? std::min(own, body) : own - std::max(0.0, body);
          lift += std::numbers::pi * std::max(0.0, both) * z * top / kDiscs;
        }
        const Immersion there = flatImmersionOf(solid, lift, 1.0 / radius);
        EXPECT_NEAR(there.depth, depth, 2e-3 * depth) << name << " " << radius << " " << depth;
      }
    }
  }
}

TEST(FlatEnd, DepthChangesAsItsSlopesSay)
{
  for (const auto& [name, tip] : kFlats)
  {
    const ToolSolid solid(tip);
    for (const double curvature : { -60.0, -15.0, 0.0, 1e-9, 12.0, 60.0 })
    {
      for (const double lift : { 1e-15, 2e-13, 5e-11, 3e-10, 2e-9 })
      {
        const Immersion here = flatImmersionOf(solid, lift, curvature);
        constexpr double step = 3e-4;
        const auto slope = [&](double l, double k)
        {
          const auto at = [&](double part)
          {
            return flatImmersionOf(
              solid, lift * (1.0 + part * l * step), curvature + part * k * step)
              .depth;
          };
          return (at(1.0) - at(-1.0)) / (2.0 * step);
        };
        EXPECT_NEAR(slope(1.0, 0.0), lift * here.byLift, 1e-5 * std::abs(here.depth) + 1e-12)
          << name << " " << curvature << " " << lift;
        EXPECT_NEAR(slope(0.0, 1.0), here.byCurvature, 1e-5 * kFlat * kFlat)
          << name << " " << curvature << " " << lift;
      }
    }
  }
}

} // namespace
} // namespace palp
