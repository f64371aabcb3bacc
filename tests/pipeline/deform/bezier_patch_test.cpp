#include "pipeline/deform/bezier_patch.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr RingCurve kCurve{ .inner = 7.0_mm, .sink = 2.0_mm, .meet = 9.0_mm, .outer = 18.0_mm };

// the three control points of Fig. 5(b), on both sides of a patch
PatchNet netOf(const RingCurve& curve)
{
  const Eigen::Vector3d p0(curve.inner, 0.0, -curve.sink);
  const Eigen::Vector3d p1(curve.meet, 0.0, 0.0);
  const Eigen::Vector3d p2(curve.outer, 0.0, 0.0);
  return { { { p0, p0 }, { p1, p1 }, { p2, p2 } } };
}

TEST(BezierPatch, HasTheCornersOfItsNet)
{
  PatchNet net;
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 2; ++j)
    {
      net[i][j] = Eigen::Vector3d::Random();
    }
  }
  EXPECT_EQ(patchPoint(net, 0.0, 0.0), net[0][0]);
  EXPECT_EQ(patchPoint(net, 1.0, 0.0), net[2][0]);
  EXPECT_EQ(patchPoint(net, 0.0, 1.0), net[0][1]);
  EXPECT_EQ(patchPoint(net, 1.0, 1.0), net[2][1]);
}

// de Casteljau's construction is another way to Eq. (8)
TEST(BezierPatch, AgreesWithRepeatedInterpolation)
{
  PatchNet net;
  for (auto& row : net)
  {
    row = { Eigen::Vector3d::Random(), Eigen::Vector3d::Random() };
  }
  const auto between = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double t)
  { return Eigen::Vector3d(a + t * (b - a)); };
  for (const double u : { 0.1, 0.37, 0.5, 0.93 })
  {
    for (const double v : { 0.0, 0.25, 0.8, 1.0 })
    {
      Eigen::Vector3d row[3];
      for (std::size_t i = 0; i < 3; ++i)
      {
        row[i] = between(net[i][0], net[i][1], v);
      }
      const Eigen::Vector3d expected =
        between(between(row[0], row[1], u), between(row[1], row[2], u), u);
      EXPECT_LT((patchPoint(net, u, v) - expected).norm(), 1e-15);
    }
  }
}

// the height over a given radius, against the parametric form of Eq. (8)
TEST(RingCurve, IsTheBezierCurveOfItsControlPoints)
{
  const PatchNet net = netOf(kCurve);
  for (int i = 0; i <= 100; ++i)
  {
    const Eigen::Vector3d at = patchPoint(net, i / 100.0, 0.5);
    EXPECT_NEAR(kCurve.sinkAt(at.x()), -at.z(), 1e-15) << "u = " << i / 100.0;
  }
}

TEST(RingCurve, IsTangentToTheToolAndToTheSurface)
{
  const double step = 1e-9;
  const double slope = kCurve.sink / (kCurve.meet - kCurve.inner);
  const double atTool = (kCurve.sinkAt(kCurve.inner) - kCurve.sinkAt(kCurve.inner + step)) / step;
  const double atSurface = kCurve.sinkAt(kCurve.outer - step) / step;
  EXPECT_NEAR(atTool, slope, 1e-5);
  EXPECT_NEAR(atSurface, 0.0, 1e-5);
  EXPECT_EQ(kCurve.sinkAt(kCurve.outer), 0.0);
  EXPECT_EQ(kCurve.sinkAt(2.0 * kCurve.outer), 0.0);
}

TEST(RingCurve, MeetsWhereTheTangentsDo)
{
  const RingCurve curve = makeRingCurve(5.0_mm, 2.0_mm, 0.5, 20.0_mm);
  EXPECT_DOUBLE_EQ(curve.meet, 9.0_mm);
}

TEST(RingCurve, KeepsItsMiddlePointBetweenTheCirclesWhenTheTangentsDoNot)
{
  EXPECT_EQ(makeRingCurve(5.0_mm, 2.0_mm, 0.05, 20.0_mm).meet, 20.0_mm); // they meet at 45 mm
  EXPECT_EQ(makeRingCurve(5.0_mm, 2.0_mm, 0.0, 20.0_mm).meet, 20.0_mm);  // parallel
  EXPECT_EQ(makeRingCurve(5.0_mm, 2.0_mm, -1.0, 20.0_mm).meet, 20.0_mm); // behind the tool
  const RingCurve vertical = makeRingCurve(5.0_mm, 2.0_mm, 1e6, 20.0_mm);
  EXPECT_NEAR(vertical.meet, 5.0_mm, 1e-8);
  const RingCurve lifted = makeRingCurve(5.0_mm, -1.0_mm, 0.5, 20.0_mm);
  EXPECT_EQ(lifted.sinkAt(6.0_mm), 0.0); // tissue is never pulled up
}

class AnyRing : public ::testing::TestWithParam<double>
{
};
INSTANTIATE_TEST_SUITE_P(RingCurve, AnyRing, ::testing::Values(0.01, 0.2, 1.0, 5.0, 1e6));

TEST_P(AnyRing, FallsOffWithoutTurning)
{
  const RingCurve curve = makeRingCurve(5.0_mm, 2.0_mm, GetParam(), 20.0_mm);
  double last = curve.sinkAt(0.0);
  for (double radius = 0.0; radius < 21.0_mm; radius += 0.05_mm)
  {
    EXPECT_LE(curve.sinkAt(radius), last + 1e-15);
    last = curve.sinkAt(radius);
  }
}

// on a plane a sphere's tangent at r = sqrt(R delta) meets the surface at about 1.5 r, so that the
// paper's construction has a place for P1 only where R_d is larger
TEST(RingRadius, ReachesPastTheToolWhereTheTableDoesNot)
{
  const Tip sphere = SphereTip{ .radius = 10.0_mm };
  const double depth = 0.1_mm;
  const double r = std::sqrt(10.0_mm * depth);
  const double radius = ringRadius(sphere, depth, r, 0.0);
  EXPECT_NEAR(radius / r, 1.05 * 1.5, 0.01);
  // the sphere leaves the plane at sqrt(2 R delta - delta^2)
  EXPECT_GT(radius, std::sqrt(2.0 * 10.0_mm * depth - depth * depth));
  EXPECT_EQ(ringRadius(sphere, depth, r, 30.0_mm), 30.0_mm);
}

TEST(RingRadius, IsAtLeastOneAndAFifthOfTheContact)
{
  const Tip punch = PunchTip{ .radius = 5.0_mm };
  EXPECT_DOUBLE_EQ(ringRadius(punch, 1.0_mm, 5.0_mm, 0.0), 6.0_mm);
}

TEST(RingRadius, IsContinuousInTheDepth)
{
  const Tip cone = ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm };
  double last = ringRadius(cone, 0.0, 0.0, 0.0);
  for (int i = 1; i <= 1000; ++i)
  {
    const double depth = i * 0.01_mm;
    const double extent = std::max(0.0, 4.0 * (depth - 0.5_mm));
    const double radius = ringRadius(cone, depth, 2.0 / std::numbers::pi * depth, extent);
    EXPECT_NEAR(radius, last, 0.05_mm);
    last = radius;
  }
}

// the law's to half of a sphere's radius; at delta = R 0.834 R, and never more than Sneddon's
// beyond
TEST(DrawnContactRadius, IsOneThatASphereCanHave)
{
  const double radius = 10.0_mm;
  const auto drawn = [&](double depth)
  { return drawnContactRadius(SphereTip{ radius }, depth, std::sqrt(radius * depth)); };
  const auto depthOf = [&](double a) // Sneddon 1965
  { return 0.5 * a * std::log((radius + a) / (radius - a)); };
  EXPECT_NEAR(drawn(radius), 0.834 * radius, 0.0005 * radius);
  for (double depth = 0.1_mm; depth < 2.0 * radius; depth += 0.01_mm)
  {
    const double a = drawn(depth);
    EXPECT_LE(a, std::sqrt(radius * depth)) << depth;
    EXPECT_GE(depthOf(a), depth * (1.0 - 1e-6)) << depth; // where a linear half-space lets go
    EXPECT_LE(depthOf(a), depth > radius ? depth * (1.0 + 1e-6) : 2.0 * depth) << depth;
    EXPECT_GT(drawn(depth + 0.01_mm), a) << depth;
    if (depth <= 0.5 * radius)
    {
      EXPECT_EQ(a, std::sqrt(radius * depth)) << depth;
    }
  }
}

} // namespace
} // namespace palp
