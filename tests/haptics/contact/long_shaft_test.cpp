#include "haptics/contact/find_contact.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kNowhere = std::numeric_limits<double>::infinity();

const std::vector<std::pair<const char*, Tip>> kTools = {
  { "pin", PunchTip{ .radius = 1.0_mm } },
  { "punch", PunchTip{ .radius = 5.0_mm } },
  { "slim cone", ConeTip{ .halfAngle = 20.0_deg, .baseRadius = 3.0_mm } },
  { "wide cone", ConeTip{ .halfAngle = 70.0_deg, .baseRadius = 8.0_mm } },
  { "truncated cone",
    TruncatedConeTip{ .halfAngle = 45.0_deg, .flatRadius = 2.0_mm, .baseRadius = 6.0_mm } },
};

test::Mesh slab(double low, double high, double wide, int n)
{
  return test::cubeMap(n,
    [=](const Vector3d& at)
    {
      return Vector3d(
        wide * at.x(), wide * at.y(), 0.5 * (low + high) + 0.5 * (high - low) * at.z());
    });
}

// a floor below z = 0, and a roof of the same body over it
Surface floorAndRoof(double roof, double thick, double wide, int n)
{
  test::Mesh mesh = slab(-80.0_mm, 0.0, 60.0_mm, 12);
  if (roof < kNowhere)
  {
    const auto [points, triangles] = slab(roof, roof + thick, wide, n);
    const auto first = static_cast<int>(mesh.first.size());
    mesh.first.insert(mesh.first.end(), points.begin(), points.end());
    for (const Triangle& t : triangles)
    {
      mesh.second.push_back({ first + t[0], first + t[1], first + t[2] });
    }
  }
  return test::makeSurface(std::move(mesh));
}

// what of a body is far up along the shaft is another part of it, whether the shaft would end in it
// or beyond: cut off there it had counted against the rest
TEST(LongShaft, PressesNoOtherPartOfTheBody)
{
  const Surface alone = floorAndRoof(kNowhere, 0.0, 0.0, 1);
  std::mt19937 random(3);
  const auto between = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  for (const auto& [name, tip] : kTools)
  {
    const double reach = 1.6 * tipHeight(tip, baseRadius(tip)) + 4.5 * baseRadius(tip);
    for (int i = 0; i < 6; ++i)
    {
      const double above = reach + between(0.0, 60.0_mm);
      const double wide = between(1.0_mm, 40.0_mm);
      const Surface both = floorAndRoof(above, between(0.5_mm, 60.0_mm), wide, i % 2 == 0 ? 1 : 7);
      const double lean = between(0.0, 0.3);
      const double turn = between(0.0, 2.0 * std::numbers::pi);
      const ToolPose pose{ .apex = { between(-9.0_mm, 9.0_mm), between(-9.0_mm, 9.0_mm),
                             -between(0.05, 0.9) * baseRadius(tip) },
        .axis = { std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn),
          -std::cos(lean) },
        .velocity = Vector3d::Zero() };
      const Contact expected = findContact(alone, tip, pose, ContactRule::Exact);
      const Contact found = findContact(both, tip, pose, ContactRule::Exact);
      ASSERT_TRUE(expected.touching()) << name;
      EXPECT_NEAR(found.depth, expected.depth, 1e-9) << name << " roof " << above;
      EXPECT_LT((found.normal - expected.normal).norm(), 1e-6) << name << " roof " << above;
      EXPECT_LT((found.center - expected.center).norm(), 1e-8) << name << " roof " << above;
      EXPECT_NEAR(found.slope, expected.slope, 1e-6) << name << " roof " << above;
    }
  }
}

// sheets have no inside that would end: what faces the tool far over its apex says nothing
TEST(LongShaft, PressesASheetBelowAnother)
{
  const Surface alone = test::makeSurface(test::sheet(120.0_mm, 9));
  for (const auto& [name, tip] : kTools)
  {
    const double reach = 1.6 * tipHeight(tip, baseRadius(tip)) + 4.5 * baseRadius(tip);
    for (const double above : { reach, reach + 20.0_mm, 0.2 })
    {
      test::Mesh mesh = test::sheet(120.0_mm, 9);
      auto [points, triangles] = test::sheet(120.0_mm, 5);
      const auto first = static_cast<int>(mesh.first.size());
      for (Vector3d& point : points)
      {
        mesh.first.emplace_back(point.x(), point.y(), above);
      }
      for (const Triangle& t : triangles)
      {
        mesh.second.push_back({ first + t[0], first + t[2], first + t[1] }); // faces down
      }
      const Surface both = test::makeSurface(std::move(mesh));
      for (const double depth : { 0.3, 0.9, 5.0 }) // of the base radius
      {
        const ToolPose pose{ .apex = { 1.3_mm, -2.1_mm, -depth * baseRadius(tip) },
          .axis = -Vector3d::UnitZ(),
          .velocity = Vector3d::Zero() };
        const Contact found = findContact(both, tip, pose, ContactRule::Exact);
        const Contact expected = findContact(alone, tip, pose, ContactRule::Exact);
        EXPECT_NEAR(expected.depth, depth * baseRadius(tip), 1e-6 * depth) << name;
        if (depth < 1.0 || above > reach + 30.0_mm)
        {
          EXPECT_NEAR(found.depth, expected.depth, 1e-9) << name << " " << above << " " << depth;
        }
      }
    }
  }
}

// an organ is asked for its contact only where this ball meets it
TEST(LongShaft, IsWithinItsReachFarBelowASheet)
{
  const Surface sheet = test::makeSurface(test::sheet(120.0_mm, 9));
  for (const auto& [name, tip] : kTools)
  {
    for (double depth = 1.0_mm; depth < 55.0_mm; depth += 2.0_mm)
    {
      const ToolPose pose{ .apex = { 1.3_mm, -2.1_mm, -depth },
        .axis = -Vector3d::UnitZ(),
        .velocity = Vector3d::Zero() };
      EXPECT_TRUE(findContact(sheet, tip, pose, ContactRule::Exact).touching()) << name << depth;
      const Reach reach = reachOf(tip, pose, ContactRule::Exact);
      EXPECT_LE(std::abs(reach.center.z()), reach.radius) << name << " " << depth;
    }
  }
}

// as deep as the body is thick: the shaft counts as far as the tool is in it
TEST(LongShaft, CountsAsFarAsTheToolIsIn)
{
  const Surface floor = floorAndRoof(40.0_mm, 10.0_mm, 50.0_mm, 3);
  for (const auto& [name, tip] : kTools)
  {
    for (double depth = 0.5_mm; depth < 39.0_mm; depth += 0.73_mm)
    {
      const ToolPose pose{ .apex = { 1.3_mm, -2.1_mm, -depth },
        .axis = -Vector3d::UnitZ(),
        .velocity = Vector3d::Zero() };
      const Contact found = findContact(floor, tip, pose, ContactRule::Exact);
      EXPECT_NEAR(found.depth, depth, 1e-6 * depth) << name << " " << depth;
      EXPECT_NEAR(found.slope, 1.0, 1e-6) << name << " " << depth;
    }
  }
}

} // namespace
} // namespace palp
