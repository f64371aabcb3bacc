#include "haptics/surface/decimation/decimate.h"

#include "haptics/error.h"
#include "haptics/surface/deviation.h"
#include "tests/support/surfaces.h"

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

TEST(Decimate, KeepsTheShapeOfASphere)
{
  const Surface fine = test::makeSurface(test::ball(0.05, 40)); // 9602 points
  const Surface coarse = decimated(fine, 2500);
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

TEST(Decimate, KeepsABlockExactly)
{
  const Surface fine = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 10));
  const Surface coarse = decimated(fine, 100);
  EXPECT_LT(deviation(fine, coarse).largest, 1e-12);
}

TEST(Decimate, RefusesTrianglesThatDoNotFit)
{
  const Surface fan({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, -1, 0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } });
  EXPECT_THROW((void)decimated(fan, 4), Error);
}

} // namespace
} // namespace palp
