#include "pipeline/deform/tool_body.h"

#include "haptics/units.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

ToolPose tilted(double angle)
{
  return { .apex = { 1.0_mm, -2.0_mm, 3.0_mm },
    .axis = Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, 0.0).normalized()) * -kUp };
}

class AnyTool : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(ToolBody, AnyTool,
  ::testing::Values(Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 45.0_deg, 10.0_mm } },
    Tip{ ConeTip{ 30.0_deg, 6.0_mm } }, Tip{ PunchTip{ 5.0_mm } },
    Tip{ BluntConeTip{ 45.0_deg, 1.0_mm, 8.0_mm } }, Tip{ ParaboloidTip{ 8.0_mm } }));

TEST_P(AnyTool, IsMetAtItsProfileWhenStraight)
{
  const ToolPose pose{ .apex = { 5.0_mm, 0.0, 2.0_mm } };
  const ToolBody body(GetParam(), pose);
  for (const double fraction : { 0.0, 0.3, 0.7, 0.99 })
  {
    const double radius = fraction * baseRadius(GetParam());
    const Eigen::Vector3d origin(5.0_mm, radius, -4.0_mm);
    EXPECT_NEAR(body.lowest(origin, kUp), 6.0_mm + tipHeight(GetParam(), radius), 1e-9);
  }
  const Eigen::Vector3d beside(5.0_mm, 1.01 * baseRadius(GetParam()), 0.0);
  EXPECT_TRUE(std::isinf(body.lowest(beside, kUp)));
}

// a point of the line, seen from below the edge of the base, is that of a circle in space
TEST_P(AnyTool, HasItsRimWhereItsBaseEnds)
{
  const double base = baseRadius(GetParam());
  for (const double angle : { 0.0, 10.0_deg, 35.0_deg, 60.0_deg })
  {
    const ToolPose pose = tilted(angle);
    const ToolBody body(GetParam(), pose);
    const Eigen::Vector3d middle = pose.apex - tipHeight(GetParam(), base) * pose.axis;
    const Eigen::Vector3d origin(middle.x(), middle.y(), -4.0_mm);
    for (double turn = 0.1; turn < 6.2; turn += 0.7)
    {
      const Eigen::Vector3d towards(std::cos(turn), std::sin(turn), 0.0);
      const Eigen::Vector3d below = origin + body.rim(origin, towards, kUp) * towards;
      const Eigen::Vector3d at = below + (middle - below).dot(pose.axis) / kUp.dot(pose.axis) * kUp;
      EXPECT_NEAR((at - middle).norm(), base, 1e-9);
    }
    const Eigen::Vector3d aside(0.0, 3.0 * base, 0.0);
    EXPECT_EQ(body.rim(origin + aside, Eigen::Vector3d::UnitX(), kUp), 0.0);
  }
}

// wherever a line enters: outside below, inside above, and no sooner seen by small steps
TEST_P(AnyTool, IsEnteredFromOutsideWhenTilted)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(-15.0_mm, 15.0_mm);
  std::uniform_real_distribution<double> angle(0.0, 60.0_deg);
  int hits = 0;
  for (int i = 0; i < 500; ++i)
  {
    const ToolBody body(GetParam(), tilted(angle(random)));
    const Eigen::Vector3d origin(position(random), position(random), position(random));
    EXPECT_EQ(body.contains(origin), body.inside(origin) > 0.0);
    const double t = body.lowest(origin, kUp);
    if (std::isinf(t))
    {
      for (double s = -30.0_mm; s < 30.0_mm; s += 0.5_mm)
      {
        EXPECT_LT(body.inside(origin + s * kUp), 1e-6);
      }
      continue;
    }
    ++hits;
    EXPECT_LE(body.inside(origin + t * kUp), 1e-12);
    EXPECT_GE(body.inside(origin + t * kUp), -1e-7);
    EXPECT_LT(body.inside(origin + (t - 0.01_mm) * kUp), 0.0);
  }
  EXPECT_GT(hits, 50);
}

TEST(ToolBody, SphereIsItsImplicitFunction)
{
  const double radius = 10.0_mm;
  const ToolPose pose = tilted(20.0_deg);
  const ToolBody body(SphereTip{ radius }, pose);
  const Eigen::Vector3d center = pose.apex - radius * pose.axis;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-12.0_mm, 12.0_mm);
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector3d point =
      center + Eigen::Vector3d(position(random), position(random), position(random));
    if ((point - center).dot(pose.axis) < 0.0)
    {
      continue; // beside the shaft
    }
    const double depth = radius - (point - center).norm();
    EXPECT_EQ(body.inside(point) > 0.0, depth > 0.0);
  }
}

} // namespace
} // namespace palp
