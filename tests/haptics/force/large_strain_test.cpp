#include "haptics/force/large_strain.h"

#include "haptics/error.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "tests/support/process.h"
#include "tests/support/shipped_ratios.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

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

// across shapes, which change from place to place, without a corner: no force may jump there
TEST(LargeStrainGrid, HoldsItsBorderOutsideAndSaysSo)
{
  EXPECT_DOUBLE_EQ(grid()(2.0, 0.2, 0.5).value, 0.9);
  EXPECT_DOUBLE_EQ(grid()(2.0, -0.1, 0.5).value, 0.95);
  const double beyond = 0.9 - 0.25 * 0.025; // half of what its slope makes of 0.05
  EXPECT_DOUBLE_EQ(grid()(2.0, 0.3, 0.5).value, beyond);
  EXPECT_DOUBLE_EQ(grid()(2.0, 9.0, 0.5).value, beyond);
  constexpr double step = 1e-4;
  double last = -0.25;
  for (double shape = 0.15; shape < 0.3; shape += step)
  {
    const double slope =
      (grid()(2.0, shape + step, 0.5).value - grid()(2.0, shape, 0.5).value) / step;
    EXPECT_NEAR(slope, last, 0.25 * 2.0 * step / 0.05) << shape;
    last = slope;
  }
  EXPECT_FALSE(grid()(2.0, 0.1, 0.4).inside);
  EXPECT_FALSE(grid()(0.5, 0.3, 0.4).inside);
}

// the ratio is above 1 for compressible and below for incompressible tissue
TEST(LargeStrainGrid, IsOneFarFromItsPoissonsRatios)
{
  EXPECT_EQ(grid()(1.0, 0.1, 0.2).value, 1.0);
  EXPECT_FALSE(grid()(1.0, 0.1, 0.2).inside);
  EXPECT_EQ(grid()(1.0, 0.2, 0.26).value, 1.08);
  EXPECT_FALSE(grid()(1.0, 0.2, 0.26).inside);
  EXPECT_TRUE(grid()(1.0, 0.2, 0.3).inside);
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

class LargeStrainFile : public ::testing::Test
{
protected:
  void write(const std::string& sphere) const
  {
    std::ofstream(sphere_) << "depth_over_radius,radius_over_thickness,poisson_ratio,force_ratio\n"
                           << sphere;
    std::ofstream(cone_) << "depth_over_thickness,half_angle_deg,poisson_ratio,force_ratio\n"
                            "0,45,0.33,1.04\n0.2,45,0.33,1.05\n";
  }

  [[nodiscard]] std::string refusal(const std::string& sphere) const
  {
    write(sphere);
    try
    {
      (void)readLargeStrain(sphere_, cone_);
    }
    catch (const Error& error)
    {
      return std::string(error.what()).substr(sphere_.string().size());
    }
    return "accepted";
  }

  test::TemporaryFolder folder_;
  std::filesystem::path sphere_ = folder_.path() / "sphere.csv";
  std::filesystem::path cone_ = folder_.path() / "cone.csv";
};

TEST_F(LargeStrainFile, IsReadInAnyOrder)
{
  write("1,0.2,0.33,1.08\n0,0.2,0.33,1\n1,0,0.33,1.04\n0,0,0.33,1\n");
  const LargeStrainTable table = readLargeStrain(sphere_, cone_);
  EXPECT_DOUBLE_EQ(table->sphere(1.0, 0.1, 0.33).value, 1.06);
  EXPECT_DOUBLE_EQ(table->cone(0.2, std::acos(-1.0) / 4.0, 0.33).value, 1.05);
  EXPECT_TRUE(table->cone.covers(std::acos(-1.0) / 4.0, 0.33));
  EXPECT_FALSE(table->cone.covers(0.5, 0.33));
}

TEST_F(LargeStrainFile, IsRefusedWithTheLine)
{
  EXPECT_EQ(refusal("0,0,0.33,1\n0,0,0.33,1\n"), ":3: given twice; give each row once");
  EXPECT_EQ(refusal("0,0,0.33\n"),
    ":2: 3 columns; give depth_over_radius,radius_over_thickness,poisson_ratio,force_ratio");
  EXPECT_EQ(refusal("0,0,0.33,1\n1,0.2,0.33,1\n").substr(0, 4), ":3: ");
}

// what has no order cannot be sorted into an axis
TEST_F(LargeStrainFile, IsRefusedWhereANumberIsNotFinite)
{
  EXPECT_EQ(refusal("0,0,0.33,1\nnan,0,0.33,1\n"), ":3: not finite; give numbers");
  EXPECT_EQ(refusal("0,0,0.33,1\n1,0,inf,1\n"), ":3: not finite; give numbers");
  EXPECT_EQ(refusal("0,0,0.33,1\n1,0,0.33,nan\n"), ":3: not finite; give numbers");
}

TEST(LargeStrain, IsFiniteHoweverShallowTheContactIs)
{
  const LawSettings settings{ .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() };
  for (const Tip& tip : { Tip{ PunchTip{ 5.0_mm } }, Tip{ ConeTip{ 70.0_deg, 5.0_mm } },
         Tip{ ParaboloidTip{ 5.0_mm } }, Tip{ BluntConeTip{ 30.0_deg, 1.0_mm, 5.0_mm } },
         Tip{ TruncatedConeTip{ 30.0_deg, 1.0_mm, 5.0_mm } } })
  {
    const ForceLaw law(tip, Material{ 5.0_kPa, 0.33 }, settings);
    const Validity validity(law);
    for (const double depth : { 5e-324, 1e-310, 1e-200, 1e-30, 1e-17, 1e-12, 1e-9, 1e-6 })
    {
      const Response response = law({ .depth = depth, .thickness = 50.0_mm });
      EXPECT_TRUE(std::isfinite(response.force) && response.force >= 0.0) << depth;
      EXPECT_TRUE(std::isfinite(response.stiffness) && response.stiffness >= 0.0) << depth;
      EXPECT_EQ(brokenRules(validity({ .depth = depth })), 0U) << tip.index() << ' ' << depth;
    }
  }
}

} // namespace
} // namespace palp
