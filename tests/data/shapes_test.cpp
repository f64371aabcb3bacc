#include "data/shapes.h"

#include "haptics/units.h"
#include "tests/data/topology.h"

#include <gtest/gtest.h>

namespace palp::test
{
namespace
{

using namespace units::literals;

struct Row
{
  int n;
  std::size_t points;
  std::size_t edges;
  std::size_t triangles;
};

class PaperGrid : public testing::TestWithParam<Row>
{
};

TEST_P(PaperGrid, HasTheCountsOfTable1)
{
  const Row& row = GetParam();
  const Mesh grid = makeGrid(row.n, 100.0_mm);
  EXPECT_EQ(grid.points.size(), row.points);
  EXPECT_EQ(edgesOf(grid).size(), row.edges);
  EXPECT_EQ(grid.triangles.size(), row.triangles);
}

// the printed table has 15482 triangles in its sixth row; V - E + F = 1 of a sheet gives 15842
INSTANTIATE_TEST_SUITE_P(Table1, PaperGrid,
  testing::Values(Row{ 40, 1600, 4641, 3042 }, Row{ 50, 2500, 7301, 4802 },
    Row{ 60, 3600, 10561, 6962 }, Row{ 70, 4900, 14421, 9522 }, Row{ 80, 6400, 18881, 12482 },
    Row{ 90, 8100, 23941, 15842 }, Row{ 100, 10000, 29601, 19602 }));

TEST(Grid, IsAFlatSquareThatFacesUp)
{
  const Mesh grid = makeGrid(40, 100.0_mm);
  EXPECT_NEAR(area(grid), 100.0_mm * 100.0_mm, 1e-15);
  EXPECT_TRUE(extent(grid).isApprox(Eigen::Vector3d(100.0_mm, 100.0_mm, 0.0), 1e-14));
  for (const auto& [a, b, c] : grid.triangles)
  {
    const Eigen::Vector3d normal =
      (grid.points[b] - grid.points[a]).cross(grid.points[c] - grid.points[a]).normalized();
    ASSERT_NEAR(normal.z(), 1.0, 1e-12);
  }
}

TEST(Box, IsClosedAndHasItsVolumeBelowTheOrigin)
{
  const Mesh box = makeBox({ 100.0_mm, 100.0_mm, 30.0_mm }, 2.5_mm);
  EXPECT_TRUE(closedAndOriented(box));
  EXPECT_EQ(euler(box), 2);
  EXPECT_NEAR(volume(box), 100.0_mm * 100.0_mm * 30.0_mm, 1e-15);
  EXPECT_NEAR(area(box), 2.0 * 100.0_mm * 100.0_mm + 4.0 * 100.0_mm * 30.0_mm, 1e-14);
  EXPECT_EQ(box.triangles.size(), 2u * (2 * 40 * 40 + 4 * 40 * 12));
  for (const Eigen::Vector3d& p : box.points)
  {
    ASSERT_LE(p.z(), 0.0);
  }
}

TEST(Box, DividesASideThatIsNoMultipleOfTheSpacingMoreFinely)
{
  const Mesh box = makeBox({ 10.0_mm, 10.0_mm, 10.0_mm }, 4.0_mm);
  EXPECT_EQ(box.triangles.size(), 2u * 6 * 3 * 3);
}

class Sphere : public testing::TestWithParam<int>
{
};

TEST_P(Sphere, IsClosedWithItsPointsOnTheRadius)
{
  const int splits = GetParam();
  const Mesh sphere = makeSphere(30.0_mm, splits);
  EXPECT_EQ(sphere.points.size(), 10u * (1u << (2 * splits)) + 2u);
  EXPECT_TRUE(closedAndOriented(sphere));
  EXPECT_EQ(euler(sphere), 2);
  for (const Eigen::Vector3d& p : sphere.points)
  {
    ASSERT_NEAR(p.norm(), 30.0_mm, 1e-16);
  }
}

INSTANTIATE_TEST_SUITE_P(Splits, Sphere, testing::Values(0, 1, 3, 5));

TEST(Sphere, NearsTheVolumeOfTheBallWithTheSquareOfTheEdge)
{
  const double ball = 4.0 / 3.0 * std::numbers::pi * 0.05 * 0.05 * 0.05;
  const double coarse = ball - volume(makeSphere(50.0_mm, 3));
  const double fine = ball - volume(makeSphere(50.0_mm, 4));
  EXPECT_GT(fine, 0.0);
  EXPECT_LT(fine / ball, 0.003);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Sphere, HasEvenTriangles)
{
  EXPECT_GT(smallestAngle(makeSphere(30.0_mm, 4)), 45.0_deg);
}

} // namespace
} // namespace palp::test
