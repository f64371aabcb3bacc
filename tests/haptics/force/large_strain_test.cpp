#include "haptics/force/large_strain.h"

#include "haptics/error.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

// two thicknesses, two Poisson's ratios, depths up to the radius
LargeStrainGrid grid()
{
  return { { 0.0, 0.25, 0.5, 1.0 }, { 0.0, 0.2 }, { 0.3, 0.5 },
    { 1.0, 1.02, 1.03, 1.04, 1.0, 1.04, 1.06, 1.08, 1.0, 0.99, 0.97, 0.95, 1.0, 0.98, 0.96, 0.9 } };
}

TEST(LargeStrainGrid, ReturnsItsNodes)
{
  EXPECT_DOUBLE_EQ(grid()(0.5, 0.0, 0.3).value, 1.03);
  EXPECT_DOUBLE_EQ(grid()(0.25, 0.2, 0.5).value, 0.98);
  EXPECT_TRUE(grid()(1.0, 0.2, 0.5).inside);
}

TEST(LargeStrainGrid, IsLinearAcrossShapesAndPoissonsRatios)
{
  EXPECT_DOUBLE_EQ(grid()(0.5, 0.1, 0.4).value, (1.03 + 1.06 + 0.97 + 0.96) / 4.0);
}

TEST(LargeStrainGrid, HoldsItsBorderOutsideAndSaysSo)
{
  EXPECT_DOUBLE_EQ(grid()(2.0, 0.3, 0.6).value, 0.9);
  EXPECT_FALSE(grid()(2.0, 0.1, 0.4).inside);
  EXPECT_FALSE(grid()(0.5, 0.3, 0.4).inside);
  EXPECT_FALSE(grid()(0.5, 0.1, 0.2).inside);
}

TEST(LargeStrainGrid, IsSmoothAndMonotoneInDepth)
{
  const LargeStrainGrid ratio = grid();
  double previous = 0.0;
  for (double depth = 0.001; depth < 1.3; depth += 0.001)
  {
    const auto here = ratio(depth, 0.1, 0.3);
    const double numeric =
      (ratio(depth + 1e-7, 0.1, 0.3).value - ratio(depth - 1e-7, 0.1, 0.3).value) / 2e-7;
    EXPECT_NEAR(here.slope, numeric, 1e-5) << depth;
    EXPECT_GE(here.value, previous);
    previous = here.value;
  }
}

TEST(LargeStrainGrid, RefusesAxesOutOfOrderAndMissingRatios)
{
  EXPECT_THROW(LargeStrainGrid({ 0.0, 0.0 }, { 0.0 }, { 0.3 }, { 1.0, 1.0 }), Error);
  EXPECT_THROW(LargeStrainGrid({ 0.0 }, { 0.0 }, { 0.3 }, { 1.0 }), Error);
  EXPECT_THROW(LargeStrainGrid({ 0.0, 1.0 }, {}, { 0.3 }, {}), Error);
  EXPECT_THROW(LargeStrainGrid({ 0.0, 1.0 }, { 0.0 }, { 0.3 }, { 1.0 }), Error);
  EXPECT_THROW(LargeStrainGrid({ 0.0, 1.0 }, { 0.0 }, { 0.3 }, { 1.0, NAN }), Error);
}

} // namespace
} // namespace palp
