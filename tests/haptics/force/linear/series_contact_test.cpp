#include "haptics/force/linear/series_contact.h"

#include "haptics/units.h"
#include "tests/support/csv_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;

const HalfSpace& sphere()
{
  static const HalfSpace law(SphereTip{ 10.0_mm });
  return law;
}

TEST(SeriesContact, OfARigidBodyIsTheHalfSpace)
{
  for (const double depth : { 1e-9, 0.1_mm, 4.0_mm, 9.9_mm, 20.0_mm })
  {
    const SeriesContact series = inSeries(sphere(), {}, depth, 10.0_mm);
    EXPECT_NEAR(series.contact.force, sphere()(depth).force, 1e-9 * sphere()(depth).force);
    EXPECT_NEAR(series.local, depth, 1e-9 * depth);
    EXPECT_FALSE(series.isBeyond);
  }
}

// a flat punch and a body are two springs: 2 a and 1 / constant
TEST(SeriesContact, OfAFlatPunchIsThatOfTwoSprings)
{
  const double a = 5.0_mm;
  const HalfSpace punch(PunchTip{ a });
  for (const double constant : { -40.0, -1.0, 3.0, 200.0, 5000.0 })
  {
    for (const double depth : { 0.01_mm, 2.0_mm, 10.0_mm })
    {
      const SeriesContact series = inSeries(punch, { .constant = constant }, depth, 0.0);
      const double stiffness = 1.0 / (1.0 / (2.0 * a) + constant);
      EXPECT_NEAR(series.contact.force, stiffness * depth, 1e-9 * stiffness * depth) << constant;
      EXPECT_NEAR(series.contact.stiffness, stiffness, 1e-6 * stiffness) << constant;
    }
  }
}

// what the tip has come down is its depth in the body and what that gives way
TEST(SeriesContact, DividesTheDepth)
{
  for (const double constant : { -20.0, 10.0, 150.0, 1000.0 })
  {
    for (const double depth : { 0.02_mm, 1.0_mm, 5.0_mm })
    {
      const SeriesContact series = inSeries(sphere(), { .constant = constant }, depth, 10.0_mm);
      EXPECT_NEAR(series.local + constant * series.contact.force, depth, 1e-9 * depth);
      const double step = 1e-4 * depth;
      const double more =
        inSeries(sphere(), { .constant = constant }, depth + step, 10.0_mm).contact.force;
      const double less =
        inSeries(sphere(), { .constant = constant }, depth - step, 10.0_mm).contact.force;
      EXPECT_NEAR(
        series.contact.stiffness, (more - less) / (2.0 * step), 1e-3 * series.contact.stiffness);
    }
  }
}

// over a support so near that the body would answer with less and less
TEST(SeriesContact, SaysWhereTheSupportIsTooNear)
{
  const double constant = -1.0 / (2.0 * 4.0_mm); // holds to a contact radius of 4 mm
  EXPECT_FALSE(inSeries(sphere(), { .constant = constant }, 0.2_mm, 10.0_mm).isBeyond);
  const SeriesContact far = inSeries(sphere(), { .constant = constant }, 5.0_mm, 10.0_mm);
  EXPECT_TRUE(far.isBeyond);
  EXPECT_TRUE(std::isfinite(far.contact.force));
  EXPECT_NEAR(far.contact.radius, 4.0_mm, 0.3_mm);
}

// a quarter of space, whose edge is so near that the ball presses over it: one compliance g / D,
// less what a block of 50 mm is stiffer by its base, at all depths and distances
TEST(SeriesContact, BesideAnEdgeIsThatOfFiniteElements)
{
  constexpr double kWedge = 0.385; // E* G0 D
  constexpr double kBase = -26.0;  // [1/m]
  constexpr double kModulus = 50e3 / (1.0 - 0.45 * 0.45);
  for (const int distance : { 2, 4, 6, 8 })
  {
    const double edge = 1000.0 / distance;
    const BodyCompliance body{
      .constant = kBase + kWedge * edge, .slope = 0.5 * kWedge * edge * edge, .edge = edge
    };
    const test::CsvTable table = test::readCsv(
      PALP_SOURCE_DIR "/data/reference/organ_edge90_" + std::to_string(distance) + "mm.csv");
    for (std::size_t i = 1; i < table["depth_m"].size(); ++i)
    {
      const double force =
        kModulus * inSeries(sphere(), body, table["depth_m"][i], 10.0_mm).contact.force;
      EXPECT_NEAR(force, table["force_N"][i], 0.01 * force) << distance << ' ' << i;
    }
  }
}

// on the slope of a lobe the pressure goes to the stiffer side, and the force with it
TEST(SeriesContact, GrowsWhereTheBodyIsSofterOnOneSide)
{
  const BodyCompliance level{ .constant = 150.0 };
  const BodyCompliance sloping{ .constant = 150.0, .slope = 5000.0 };
  const double even = inSeries(sphere(), level, 4.0_mm, 10.0_mm).contact.force;
  EXPECT_GT(inSeries(sphere(), sloping, 4.0_mm, 10.0_mm).contact.force, even);
  EXPECT_EQ(inSeries(sphere(), sloping, 4.0_mm, 0.0).contact.force,
    inSeries(sphere(), level, 4.0_mm, 0.0).contact.force);
}

} // namespace
} // namespace palp
