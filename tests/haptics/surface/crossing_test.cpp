// Surfaces that cross themselves: folds of a scanner, bodies that overlap.

#include "haptics/contact/find_contact.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/surface.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRadius = 30.0_mm;

// a ball whose cap was turned inside out in its place, as segmentations leave it
test::Mesh foldedBall(double capRadius, double factor)
{
  test::Mesh mesh = test::ball(kRadius, 24);
  for (Eigen::Vector3d& point : mesh.first)
  {
    if (point.z() > 0.0 && point.head<2>().norm() < capRadius)
    {
      point.head<2>() *= factor;
    }
  }
  return mesh;
}

double signedDistance(const Surface& surface, const Eigen::Vector3d& place)
{
  return findClosestPoint(surface, place, std::numeric_limits<double>::infinity()).distance;
}

TEST(Crossing, IsFoundWhereTrianglesPassThroughEachOther)
{
  const auto crossing = [](test::Mesh mesh)
  { return test::makeSurface(std::move(mesh)).crossing(); };
  const test::Mesh block = test::block(Eigen::Vector3d::Constant(20.0_mm), 5);
  EXPECT_FALSE(crossing(block));
  EXPECT_FALSE(crossing(test::ball(kRadius, 12)));
  EXPECT_FALSE(crossing(test::sheet(50.0_mm, 9)));
  EXPECT_FALSE(crossing(test::withCopyAt(block, { 20.0_mm, 20.0_mm, 0.0 }))) << "edge to edge";
  EXPECT_FALSE(crossing(test::withCopyAt(block, { 20.1_mm, 0.0, 0.0 }))) << "apart";
  const auto overlap = crossing(test::withCopyAt(block, { 13.0_mm, 7.3_mm, 1.7_mm }));
  ASSERT_TRUE(overlap);
  EXPECT_GT(overlap->x(), 3.0_mm - 1e-9); // of the copy's near side
  EXPECT_LT(overlap->x(), 10.0_mm + 1e-9);
  EXPECT_TRUE(crossing(foldedBall(3.0_mm, -0.9)));
  EXPECT_TRUE(crossing(foldedBall(8.0_mm, -1.1)));
}

// walls that meet exactly: no edge passes through the middle of a triangle
TEST(Crossing, PiecesThatMeetInEdgesOrPlanesOverlap)
{
  const auto thickness = [](const Surface& surface, const Eigen::Vector3d& from)
  { return surface.shape()(from, 4.0_mm, Eigen::Vector3d::UnitX(), 0.0).thickness; };
  const test::Mesh block = test::block(Eigen::Vector3d::Constant(20.0_mm), 5);
  for (const Eigen::Vector3d& shift :
    { Eigen::Vector3d(13.0_mm, 0.0, 0.0), Eigen::Vector3d(12.0_mm, 0.0, 0.0),
      Eigen::Vector3d(8.0_mm, 0.0, 0.0), Eigen::Vector3d(20.0_mm, 0.0, 0.0),
      Eigen::Vector3d(20.0_mm - 1e-9, 0.0, 0.0), Eigen::Vector3d(20.0_mm - 1e-7, 0.0, 0.0) })
  {
    const Surface both = test::makeSurface(test::withCopyAt(block, shift));
    ASSERT_TRUE(both.crossing()) << shift.transpose();
    EXPECT_NEAR(
      thickness(both, { 10.0_mm + shift.x(), 0.0, -10.0_mm }), 20.0_mm + shift.x(), 0.02 * 20.0_mm);
  }
  test::Mesh balls; // mirrored, so that their triangles meet edge to edge
  const test::Mesh ball = test::ball(20.0_mm, 16);
  const int count = static_cast<int>(ball.first.size());
  for (const double side : { 1.0, -1.0 })
  {
    for (const Eigen::Vector3d& p : ball.first)
    {
      balls.first.emplace_back(side * (p.x() + 10.3_mm), p.y(), p.z());
    }
    for (const auto& [a, b, c] : ball.second)
    {
      side > 0.0 ? balls.second.push_back({ a, b, c })
                 : balls.second.push_back({ c + count, b + count, a + count });
    }
  }
  const Surface both = test::makeSurface(balls);
  ASSERT_TRUE(both.crossing());
  EXPECT_NEAR(thickness(both, { 30.3_mm, 0.0, 0.0 }), 59.0_mm, 2.0_mm); // 60.6 along the axis
}

// a block on another, coplanar at two sides, with points in common or not
TEST(Crossing, WhatStandsOnABodyIsOneWithIt)
{
  for (const int cells : { 16, 25 }) // of the lower one, 80 mm wide; 2.5 mm of the upper one
  {
    test::Mesh both = test::block({ 80.0_mm, 80.0_mm, 40.0_mm }, cells);
    const test::Mesh upper = test::block({ 40.0_mm, 40.0_mm, 30.0_mm }, 16);
    const int count = static_cast<int>(both.first.size());
    for (const Eigen::Vector3d& p : upper.first)
    {
      both.first.emplace_back(p + Eigen::Vector3d(20.0_mm, 20.0_mm, 30.0_mm));
    }
    for (const auto& [a, b, c] : upper.second)
    {
      both.second.push_back({ a + count, b + count, c + count });
    }
    std::map<std::array<long, 3>, int> known; // as a reader merges them
    for (Triangle& triangle : both.second)
    {
      for (int& corner : triangle)
      {
        const Eigen::Vector3d p = both.first[at(corner)] / 1e-9;
        corner =
          known.insert({ { std::lround(p.x()), std::lround(p.y()), std::lround(p.z()) }, corner })
            .first->second;
      }
    }
    const Surface surface = test::makeSurface(both);
    EXPECT_TRUE(surface.closed());
    ASSERT_TRUE(surface.crossing());
    for (const double depth : { 0.5_mm, 2.0_mm, 4.0_mm })
    {
      const Contact contact = findContact(surface, SphereTip{ 5.0_mm },
        { .apex = { 20.0_mm, 20.0_mm, 30.0_mm - depth }, .axis = -Eigen::Vector3d::UnitZ() },
        ContactRule::Exact);
      EXPECT_NEAR(contact.depth, depth, 1e-6) << cells;
      EXPECT_NEAR(contact.thickness, 70.0_mm, 1.0_mm) << cells;
      EXPECT_NEAR(contact.surfaceCurvature, 0.0, 0.5);
    }
  }
}

// of two blocks, each a product of intervals, it is known who is inside how many
TEST(Crossing, WhatIsInsideOfOverlappingBlocksIsInside)
{
  const double side = 20.0_mm;
  const Eigen::Vector3d shift(13.0_mm, 7.3_mm, 1.7_mm);
  const Surface both =
    test::makeSurface(test::withCopyAt(test::block(Eigen::Vector3d::Constant(side), 5), shift));
  const auto isIn = [&](const Eigen::Vector3d& place)
  {
    return (place.array().head<2>().abs() < 0.5 * side).all() && place.z() < 0.0 &&
      place.z() > -side;
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-30.0_mm, 40.0_mm);
  int inside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Eigen::Vector3d place(anywhere(random), anywhere(random), anywhere(random) - 10.0_mm);
    const int expected = int{ isIn(place) } + int{ isIn(place - shift) };
    const double winding = (*both.winding())(place);
    const double distance = signedDistance(both, place);
    if (std::abs(distance) > 1e-6)
    {
      ASSERT_NEAR(winding, expected, 0.05) << place.transpose();
      ASSERT_EQ(distance<0.0, expected> 0) << place.transpose();
    }
    inside += expected > 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 500);
}

// under the top of a block the walls of another that stand in it are not felt
TEST(Crossing, AToolFeelsNoWallWithinTheBody)
{
  const Surface both = test::makeSurface(test::withCopyAt(
    test::block(Eigen::Vector3d::Constant(40.0_mm), 20), { 23.0_mm, 0.7_mm, -6.0_mm }));
  for (const Tip& tip : { Tip(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm }),
         Tip(SphereTip{ .radius = 2.0_mm }), Tip(PunchTip{ .radius = 3.0_mm }) })
  {
    for (const double depth : { 1.0_mm, 3.0_mm, 5.0_mm, 7.0_mm, 9.0_mm })
    {
      for (double x = -8.0_mm; x < 8.0_mm; x += 0.1_mm) // the wall stands at 3 mm
      {
        const Contact contact = findContact(both, tip,
          { .apex = { x, 1.3_mm, -depth },
            .axis = -Eigen::Vector3d::UnitZ(),
            .velocity = Eigen::Vector3d::Zero() },
          ContactRule::Exact);
        ASSERT_NEAR(contact.depth, depth, 0.02 * depth) << x;
        ASSERT_GT(contact.normal.z(), 0.999) << x;
      }
    }
  }
}

} // namespace
} // namespace palp
