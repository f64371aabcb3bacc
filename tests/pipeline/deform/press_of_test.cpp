#include "pipeline/deform/press_of.h"

#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

const Tip kBall{ SphereTip{ 10.0_mm } };

Sample pressedTo(double depth)
{
  Sample sample;
  sample.pose = { .apex = { 0.0, 0.0, -depth }, .axis = -Eigen::Vector3d::UnitZ() };
  sample.contact.depth = depth;
  sample.contact.normal = Eigen::Vector3d::UnitZ();
  sample.response.contactRadius = std::sqrt(10.0_mm * depth);
  return sample;
}

double deepestOf(const Press& press)
{
  DentedSurface surface = test::plane(80, 0.75_mm);
  surface.press(press);
  double deepest = 0.0;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    deepest = std::max(deepest, -DentedSurface::at(surface.points, i).z());
  }
  return deepest;
}

// of a sharp tool that leans the surface goes another way than the contact says
TEST(PressOf, TheContactIsDrawnBelowTheNose)
{
  const Tip needle{ ConeTip{ 20.0_deg, 4.0_mm } };
  for (const double tilt : { 0.0, 5.0_deg, 20.0_deg, 50.0_deg })
  {
    Sample sample = pressedTo(4.0_mm);
    sample.pose.axis = { std::sin(tilt), 0.0, -std::cos(tilt) };
    const Press press = pressOf(sample, needle, 12.0_mm, {});
    const Eigen::Vector3d& way = press.contact.normal;
    EXPECT_NEAR(press.contact.center.z(), 0.0, 1e-12);
    EXPECT_NEAR((press.contact.center - press.pose.apex).cross(way).norm(), 0.0, 1e-12);
    EXPECT_NEAR(std::acos(way.z()), std::max(0.0, tilt - 8.0_deg), 1e-7);
  }
}

// tissue that relaxes comes back after the tool
TEST(PressOf, WhatHasNotComeBackIsSeen)
{
  const Sample left = pressedTo(4.0_mm);
  Sample away;
  away.pose.apex.z() = 20.0_mm;
  EXPECT_EQ(deepestOf(pressOf(drawnSample(away, left), kBall, 0.0, {})), 0.0);
  double before = deepestOf(pressOf(left, kBall, 18.0_mm, {}));
  for (const double rest : { 3.0_mm, 1.5_mm, 0.5_mm })
  {
    away.surfaceDepth = rest;
    const Sample drawn = drawnSample(away, left);
    EXPECT_EQ(drawnDepth(drawn), rest);
    const double deepest = deepestOf(pressOf(drawn, kBall, 12.0_mm, {}));
    EXPECT_NEAR(deepest, rest, 0.05_mm);
    EXPECT_LT(deepest, before);
    before = deepest;
  }
  away.surfaceDepth = 1.0_mm;
  away.organ = 1; // which nothing has touched
  EXPECT_FALSE(drawnSample(away, left).contact.touching());
}

// a tool that is lifted faster than the tissue follows
TEST(PressOf, SurfaceMayBeDeeperThanTheTool)
{
  Sample sample = pressedTo(2.0_mm);
  sample.surfaceDepth = 3.0_mm;
  const Press press = pressOf(sample, kBall, 15.0_mm, {});
  EXPECT_EQ(press.contact.depth, 3.0_mm);
  EXPECT_NEAR(press.pose.apex.z(), -3.0_mm, 1e-12);
  sample.surfaceDepth = 0.0;
  EXPECT_EQ(pressOf(sample, kBall, 15.0_mm, {}).contact.depth, 2.0_mm);
}

// R_d of a table is that of a sink of a set depth, and ends inside of a contact that is less deep
TEST(PressOf, TheExtentIsNeverInsideTheContact)
{
  const Press tiny = pressOf(pressedTo(0.1_mm), kBall, 0.6_mm, {});
  EXPECT_NEAR(tiny.contactRadius, 1.0_mm, 1e-9);
  EXPECT_EQ(tiny.extentRadius, tiny.contactRadius);
  EXPECT_EQ(pressOf(pressedTo(2.0_mm), kBall, 15.0_mm, {}).extentRadius, 15.0_mm);
  EXPECT_EQ(pressOf(pressedTo(2.0_mm), kBall, 0.0, {}).extentRadius, 0.0); // no table
}

} // namespace
} // namespace palp
