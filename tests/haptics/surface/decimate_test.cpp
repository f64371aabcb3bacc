#include "haptics/surface/decimation/decimate.h"

#include "haptics/error.h"
#include "haptics/surface/sampling/deviation.h"
#include "tests/support/surfaces.h"

#include <array>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

// the distance between two spheres, however they are meshed, is that of their radii
TEST(Deviation, OfTwoSpheresIsTheirDifference)
{
  const Surface inner = test::makeSurface(test::ball(1.0, 60));
  const Surface outer = test::makeSurface(test::ball(1.01, 60));
  const Deviation apart = deviation(inner, outer);
  EXPECT_NEAR(apart.rootMeanSquare, 0.01, 3e-4);
  EXPECT_NEAR(apart.largest, 0.01, 1e-3);
  EXPECT_EQ(deviation(inner, inner).largest, 0.0);
}

Surface coarser(const Surface& fine, std::size_t count, double error = 1.0)
{
  TriangleMesh mesh = decimated(fine.points(), fine.triangles(), count, error);
  return { std::move(mesh.points), std::move(mesh.triangles) };
}

TEST(Decimate, KeepsTheShapeOfASphere)
{
  const Surface fine = test::makeSurface(test::ball(0.05, 40)); // 9602 points
  const Surface coarse = coarser(fine, 2500);
  EXPECT_LE(coarse.points().size(), 2500U);
  EXPECT_GE(coarse.points().size(), 2400U);
  EXPECT_TRUE(coarse.closed());
  EXPECT_EQ(coarse.triangles().size(), 2 * coarse.points().size() - 4); // Euler
  // no more than the sagitta of its own edges
  const double sagitta = coarse.edgeLength() * coarse.edgeLength() / (8.0 * 0.05);
  EXPECT_LT(deviation(fine, coarse).largest, 3.0 * sagitta);
  for (const Facet& facet : coarse.tree().facets())
  {
    EXPECT_GT(facet.normal.dot(facet.corners[0].normalized()), 0.9); // none turned over
  }
}

TEST(Decimate, ToSeveralCountsIsThatToEachOfThem)
{
  const Surface fine = test::makeSurface(test::ball(0.05, 40));
  const std::array<std::size_t, 3> counts{ 5000, 2500, 300 };
  std::vector<TriangleMesh> levels;
  const auto take = [&](TriangleMesh mesh)
  {
    levels.push_back(std::move(mesh));
    return true;
  };
  decimateTo(counts, fine.points(), fine.triangles(), 1.0, take);
  ASSERT_EQ(levels.size(), 3U);
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    const TriangleMesh alone = decimated(fine.points(), fine.triangles(), counts[i], 1.0);
    EXPECT_LE(levels[i].points.size(), counts[i]);
    EXPECT_TRUE(Surface(levels[i].points, levels[i].triangles).closed());
    EXPECT_LT(deviation(Surface(levels[i].points, levels[i].triangles),
                Surface(alone.points, alone.triangles))
                .largest,
      1.5 * deviation(fine, Surface(alone.points, alone.triangles)).largest + 1e-6);
  }
}

TEST(Decimate, EndsWhereTheRestIsNotWanted)
{
  const Surface fine = test::makeSurface(test::ball(0.05, 40));
  const std::array<std::size_t, 3> counts{ 5000, 2500, 300 };
  std::size_t taken = 0;
  decimateTo(counts, fine.points(), fine.triangles(), 1.0,
    [&](const TriangleMesh& mesh)
    {
      EXPECT_GT(mesh.points.size(), 2000U);
      return ++taken < 2;
    });
  EXPECT_EQ(taken, 2U);
}

TEST(Decimate, KeepsABlockExactly)
{
  const Surface fine = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 10));
  const Surface coarse = coarser(fine, 100);
  EXPECT_LT(deviation(fine, coarse).largest, 1e-12);
}

// as a rim of the liver: what it lacks at most is more points
TEST(Decimate, KeepsAWedgeWhereAnErrorIsGiven)
{
  test::Mesh lens = test::ball(0.05, 60);
  for (Eigen::Vector3d& point : lens.first)
  {
    point.z() *= 0.05;
  }
  const Surface fine = test::makeSurface(std::move(lens));
  constexpr double error = 1e-5;
  const Surface close = coarser(fine, 50, error);
  EXPECT_GT(close.points().size(), 100U);
  EXPECT_LT(close.points().size(), fine.points().size() / 4);
  EXPECT_LT(deviation(fine, close).largest, 10.0 * error);
  EXPECT_GT(deviation(fine, coarser(fine, 50)).largest, 10.0 * error);
}

TEST(Decimate, RefusesTrianglesThatDoNotFit)
{
  const Surface fan({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } });
  EXPECT_THROW((void)coarser(fan, 4), Error);
}

} // namespace
} // namespace palp
