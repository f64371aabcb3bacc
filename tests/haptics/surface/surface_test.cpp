#include "haptics/surface/surface.h"

#include "haptics/error.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/ray.h"
#include "tests/support/sampled.h"
#include "tests/support/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace palp
{
namespace
{

TEST(Surface, RefusesWhatCannotBeSearched)
{
  const std::vector<Eigen::Vector3d> corner = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  EXPECT_THROW(Surface({}, {}), Error);
  EXPECT_THROW(Surface(corner, {}), Error);
  EXPECT_THROW(Surface(corner, { { 0, 1, 3 } }), Error);
  EXPECT_THROW(Surface(corner, { { 0, 1, -1 } }), Error);
  EXPECT_THROW(Surface(corner, { { 0, 1, 1 } }), Error); // no area
  auto broken = corner;
  broken[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Surface(broken, { { 0, 1, 2 } }), Error);
}

TEST(Surface, NeighborsAreThePointsAcrossTheEdges)
{
  const Surface surface = test::makeSurface(test::ball(1.0, 5));
  std::vector<std::set<int>> expected(surface.points().size());
  for (const Triangle& t : surface.triangles())
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      expected[static_cast<std::size_t>(t[k])].insert({ t[(k + 1) % 3], t[(k + 2) % 3] });
    }
  }
  for (int i = 0; i < static_cast<int>(expected.size()); ++i)
  {
    const auto found = surface.neighbors(i);
    const std::set<int> unique(found.begin(), found.end());
    EXPECT_EQ(unique.size(), found.size());
    EXPECT_EQ(unique, expected[static_cast<std::size_t>(i)]);
  }
}

TEST(Surface, KnowsItsOpenEdges)
{
  EXPECT_TRUE(test::makeSurface(test::ball(1.0, 4)).closed());
  const Surface sheet = test::makeSurface(test::sheet(1.0, 11));
  EXPECT_FALSE(sheet.closed());
  EXPECT_TRUE(sheet.onOpenEdge(0));
  EXPECT_FALSE(sheet.onOpenEdge(5 * 11 + 5));
  for (int triangle = 0; triangle < static_cast<int>(sheet.triangles().size()); ++triangle)
  {
    const int point = sheet.triangles()[static_cast<std::size_t>(triangle)][0];
    const Eigen::Vector3d& p = sheet.points()[static_cast<std::size_t>(point)];
    const double expected = 0.5 - std::max(std::abs(p.x()), std::abs(p.y()));
    EXPECT_NEAR(sheet.edgeDistance(p, triangle), expected, 1e-12);
  }
}

// boxes that are too small, a wrong turn in the tree, or a wrong side at an edge or corner would
// show against the closed form of a block
TEST(Surface, SignedDistanceIsThatOfTheBlock)
{
  const Eigen::Vector3d size(1.0, 0.6, 0.4);
  const Surface surface = test::makeSurface(test::block(size, 12));
  EXPECT_EQ(surface.tree().facets().size(), surface.triangles().size());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i)
  {
    const Eigen::Vector3d x(position(random), position(random), position(random));
    const Eigen::Vector3d middle(0.0, 0.0, -0.5 * size.z());
    const Eigen::Array3d beyond = (x - middle).array().abs() - 0.5 * size.array();
    const double exact =
      beyond.max(0.0).matrix().norm() + std::min(0.0, static_cast<double>(beyond.maxCoeff()));
    const ClosestPoint nearest =
      findClosestPoint(surface, x, std::numeric_limits<double>::infinity());
    EXPECT_NEAR(nearest.distance, exact, 1e-12);
    EXPECT_NEAR((nearest.point - x).norm(), std::abs(exact), 1e-12);
  }
}

TEST(Surface, FarSideOfABlockIsItsThickness)
{
  const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.03 }, 9));
  EXPECT_NEAR(
    rayExit(block.tree(), { 0.01, 0.02, 0.0 }, -Eigen::Vector3d::UnitZ()).distance, 0.03, 1e-12);
  EXPECT_EQ(rayExit(block.tree(), { 0.0, 0.2, 0.0 }, -Eigen::Vector3d::UnitZ()).distance,
    std::numeric_limits<double>::infinity());
}

// a block whose faces are there twice, once turned over, and a sheet with two faces; askew, so that
// places are not exact
TEST(Surface, AWallTurnedOverIsNoThickness)
{
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
  const auto thicknessOf = [&](test::Mesh mesh)
  {
    for (Eigen::Vector3d& point : mesh.first)
    {
      point = turn * point;
    }
    for (const auto& [a, b, c] : std::vector<Triangle>(mesh.second))
    {
      mesh.second.push_back({ a, c, b });
    }
    const Surface surface = test::makeSurface(mesh);
    const Eigen::Vector3d up = turn * Eigen::Vector3d::UnitZ();
    return surface.shape()(Eigen::Vector3d::Zero(), surface.shape().finest(), up, 0.0).thickness;
  };
  EXPECT_NEAR(thicknessOf(test::block({ 0.1, 0.1, 0.05 }, 10)), 0.05, 1e-6);
  EXPECT_EQ(thicknessOf(test::sheet(0.1, 11)), std::numeric_limits<double>::infinity());
}

// a ray that meets an edge or a corner leaves through one of their triangles, in whatever pose
TEST(Surface, FarSideHasNoGapsBetweenItsTriangles)
{
  constexpr int kCells = 4;
  const Eigen::Vector3d size(0.03, 0.03, 0.03);
  const test::Mesh straight = test::block(size, kCells);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int missed = 0;
  for (int pose = 0; pose < (test::kSanitized ? 4 : 60); ++pose)
  {
    const Eigen::Quaterniond turn =
      Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    const Eigen::Vector3d shift(any(random), any(random), any(random));
    const auto placed = [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(turn * x + shift); };
    test::Mesh mesh = straight;
    for (Eigen::Vector3d& x : mesh.first)
    {
      x = placed(x);
    }
    const Surface surface = test::makeSurface(mesh);
    for (int i = 0; i <= 2 * kCells; ++i) // nodes, and middles of edges
    {
      for (int j = 0; j <= 2 * kCells; ++j)
      {
        const Eigen::Vector3d below(
          size.x() * (0.5 * i / kCells - 0.5), size.y() * (0.5 * j / kCells - 0.5), -size.z());
        const Eigen::Vector3d aslant(
          0.2 * size.x() * any(random), 0.2 * size.y() * any(random), 0.0);
        for (const Eigen::Vector3d& above : { Eigen::Vector3d(below.x(), below.y(), 0.0), aslant })
        {
          const bool grazes =
            above.x() == below.x() && (i % (2 * kCells) == 0 || j % (2 * kCells) == 0);
          if (!grazes) // no ray within a side of the block
          {
            const double thickness = (below - above).norm();
            const double found =
              rayExit(surface.tree(), placed(above), (placed(below) - placed(above)).normalized())
                .distance;
            missed += std::abs(found - thickness) < 1e-9 ? 0 : 1;
          }
        }
      }
    }
  }
  EXPECT_EQ(missed, 0);
}

// where a long triangle meets two short ones, a third, without area but for rounding, lies between
test::Mesh roofWithATJoint(double slope, const Eigen::Quaterniond& turn)
{
  test::Mesh mesh{ { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, -slope }, { 0, 1, -slope },
                     { 0.1, 0, 0 } },
    { { 0, 1, 3 }, { 0, 2, 4 }, { 4, 2, 1 }, { 0, 4, 1 } } };
  for (Eigen::Vector3d& x : mesh.first)
  {
    x = turn * x;
  }
  return mesh;
}

class TJoint : public ::testing::TestWithParam<double> // slope of the roof
{
};
INSTANTIATE_TEST_SUITE_P(Surface, TJoint, ::testing::Values(0.0, 0.5, -0.5));

TEST_P(TJoint, SliverOfRoundingHasNoSayInNormalsAndSides)
{
  const double slope = GetParam();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int pose = 0; pose < (test::kSanitized ? 4 : 200); ++pose)
  {
    const Eigen::Quaterniond turn =
      Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    const Surface surface = test::makeSurface(roofWithATJoint(slope, turn));
    const Eigen::Vector3d up = turn * Eigen::Vector3d::UnitZ();
    if (slope == 0.0)
    {
      for (const Eigen::Vector3d& normal : surface.normals())
      {
        ASSERT_LT((normal - up).norm(), 1e-9);
      }
    }
    for (const double x : { -0.2, 0.0, 0.3 })
    {
      const Eigen::Vector3d ridge = turn * Eigen::Vector3d(x, 0, 0);
      const double out = findClosestPoint(surface, ridge + 0.01 * up, 1.0).distance;
      const double in = findClosestPoint(surface, ridge - 0.01 * up, 1.0).distance;
      const double aside = 0.01 / std::hypot(1.0, slope); // of the slopes, from where they meet
      ASSERT_NEAR(out, slope < 0.0 ? aside : 0.01, 1e-9) << x;
      ASSERT_NEAR(in, slope > 0.0 ? -aside : -0.01, 1e-9) << x;
    }
  }
}

// against all triangles, one by one; in the third and fourth case other ones have no area than
// before
TEST(BoxTree, OfMovedPointsFindsTheNearestTriangle)
{
  const auto [ball, triangles] = test::ball(1.0, 6);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  const auto anywhere = [&](double far)
  { return Eigen::Vector3d(far * within(random), far * within(random), far * within(random)); };
  for (const auto& [far, isFlatBefore, isFlatAfter] : { std::tuple(0.02, false, false),
         { 5.0, false, false }, { 0.02, true, false }, { 0.02, false, true } })
  {
    std::vector<Eigen::Vector3d> points = ball;
    std::vector<Eigen::Vector3d> moved = ball;
    for (Eigen::Vector3d& point : moved)
    {
      point += anywhere(far);
    }
    const auto& [from, to, other] = triangles[5];
    const auto flatten = [a = at(from), b = at(to)](auto& all) { all[a] = all[b]; };
    isFlatBefore ? flatten(points) : void();
    isFlatAfter ? flatten(moved) : void();
    const BoxTree tree = BoxTree(points, triangles).moved(moved, triangles);
    for (int i = 0; i < 200; ++i)
    {
      const Eigen::Vector3d place = anywhere(2.0);
      double least = 100.0;
      for (const Triangle& triangle : triangles)
      {
        least = distanceTo(BoxTree(moved, { &triangle, 1 }), place, least);
      }
      ASSERT_NEAR(distanceTo(tree, place, 100.0), least, 1e-12) << far;
    }
  }
}

} // namespace
} // namespace palp
