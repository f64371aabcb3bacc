#include "haptics/contact/ball/disc_integral.h"
#include "haptics/contact/ball/patch.h"
#include "haptics/surface/closest_point.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

// triangle by triangle, each seen for itself; without what only fading ones add
Patch summed(const Surface& surface, const PatchBall& ball, double inside)
{
  const double squared = ball.radius * ball.radius;
  const double full = 2.0 / 15.0 * squared * squared * ball.radius;
  Patch sum;
  sum.solidAngle = 4.0 * std::numbers::pi * inside;
  for (const Facet& facet : surface.tree().facets())
  {
    RimAngle unused(ball.radius);
    const DiscIntegral within = integrate(facet, ball.center, squared, unused);
    const double height = facet.normal.dot(ball.center - facet.corners[0]);
    const double faced = std::clamp(1.0 + ball.turning * height, 0.0, 1.0);
    const double part = faced * faced * (3.0 - 2.0 * faced);
    const double byHeight = faced < 1.0 ? 6.0 * faced * (1.0 - faced) * ball.turning : 0.0;
    const Eigen::Vector3d slope = part * within.slope + within.weight * byHeight * facet.normal;
    sum.solidAngle -= part * std::copysign(solidAngleOf(facet, ball.center, squared), -height);
    sum.weight += part * within.weight;
    sum.normal += part * within.weight * facet.normal;
    sum.area += part * within.area * facet.normal;
    sum.volume -= part * height * within.area / 3.0;
    sum.moment -= part * height * (2.0 / 15.0 * squared * within.area + 0.2 * within.weight);
    sum.slopes.normal += facet.normal * slope.transpose();
    sum.slopes.weight += slope;
    sum.slopes.area += part * within.area;
  }
  sum.volume += squared * ball.radius * sum.solidAngle / 3.0;
  sum.moment += full * sum.solidAngle;
  return sum;
}

void expectSame(
  const Surface& surface, const PatchBall& ball, double inside, double rounding = 1e-9)
{
  const Patch patch = patchWithin(surface, ball, inside);
  const Patch sum = summed(surface, ball, inside);
  const double r = ball.radius;
  EXPECT_NEAR(patch.solidAngle, sum.solidAngle, rounding);
  EXPECT_NEAR(patch.weight, sum.weight, rounding * std::pow(r, 4));
  EXPECT_NEAR(patch.volume, sum.volume, rounding * std::pow(r, 3));
  EXPECT_NEAR(patch.moment, sum.moment, rounding * std::pow(r, 5));
  EXPECT_NEAR(patch.slopes.area, sum.slopes.area, rounding * r * r);
  EXPECT_LT((patch.normal - sum.normal).norm(), rounding * std::pow(r, 4));
  EXPECT_LT((patch.area - sum.area).norm(), rounding * r * r);
  EXPECT_LT((patch.slopes.normal - sum.slopes.normal).norm(), rounding * std::pow(r, 3));
  EXPECT_LT((patch.slopes.weight - sum.slopes.weight).norm(), rounding * std::pow(r, 3));
}

// with a center near the surface, in front of it and behind, and from shallow to wholly around it
void expectSameAbout(const Surface& surface, double size, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const std::size_t last = surface.points().size() - 1;
  for (int i = 0; i < 300; ++i)
  {
    const auto point = std::uniform_int_distribution<std::size_t>(0, last)(random);
    const double radius = size * std::pow(10.0, unit(random));
    const Eigen::Vector3d center = surface.points()[point] +
      0.9 * radius * Eigen::Vector3d(unit(random), unit(random), unit(random));
    const ClosestPoint nearest =
      findClosestPoint(surface, center, std::numeric_limits<double>::infinity());
    const double turning = i % 3 == 0 ? 0.0 : unit(random) / radius;
    SCOPED_TRACE(i);
    expectSame(surface, { center, radius, turning }, nearest.distance < 0.0 ? 1.0 : 0.0);
  }
}

Eigen::Vector3d bumpy(const Eigen::Vector3d& cube)
{
  const Eigen::Vector3d out = cube.normalized();
  return (1.0 + 0.1 * std::sin(7.0 * out.x()) * std::cos(5.0 * out.y() + out.z())) * out;
}

TEST(PatchSums, AreThoseOfTheTrianglesOfAClosedBody)
{
  expectSameAbout(test::makeSurface(test::cubeMap(20, bumpy)), 0.3, 1);
  expectSameAbout(test::makeSurface(test::cubeMap(5, bumpy)), 0.3, 2);
}

TEST(PatchSums, AreThoseOfTheTrianglesOfABlockAndOfASheet)
{
  expectSameAbout(test::makeSurface(test::block({ 1.0, 0.6, 0.1 }, 1)), 0.2, 3);
  expectSameAbout(test::makeSurface(test::block({ 1.0, 0.6, 0.1 }, 12)), 0.1, 4);
  const auto wave = [](double x, double y) { return 0.05 * std::sin(9.0 * x + 4.0 * y); };
  expectSameAbout(test::makeSurface(test::sheet(1.0, 30, wave)), 0.1, 5);
}

// corners upon the ball, by 5, 12 and 13: rounding says on which side they are, and its root how
// long a side within is
TEST(PatchSums, AreThoseOfTheTrianglesWhereCornersAreUponTheBall)
{
  constexpr double kRoot = 2e-8;
  const Surface grid = test::makeSurface(test::sheet(40.0, 41));
  for (const double side : { 1.0, -1.0 })
  {
    for (const double off : { -1e-15, 0.0, 1e-15 })
    {
      const PatchBall ball{ { off, 0.0, side * 12.0 }, 13.0, 0.0 };
      expectSame(grid, ball, side < 0.0 ? 1.0 : 0.0, kRoot);
      const double angle = patchWithin(grid, ball, side < 0.0 ? 1.0 : 0.0).solidAngle;
      EXPECT_NEAR(angle, 2.0 * std::numbers::pi * (1.0 - side * 12.0 / 13.0), kRoot);
    }
  }
}

// far from the origin sums of squares would be all rounding
TEST(PatchSums, HoldFarFromTheOrigin)
{
  const auto far = [](const Eigen::Vector3d& cube)
  { return Eigen::Vector3d(0.01 * bumpy(cube) + Eigen::Vector3d(30.0, -20.0, 10.0)); };
  const auto near = [](const Eigen::Vector3d& cube) { return Eigen::Vector3d(0.01 * bumpy(cube)); };
  const Surface there = test::makeSurface(test::cubeMap(20, far));
  const Surface here = test::makeSurface(test::cubeMap(20, near));
  const Eigen::Vector3d center(0.003, 0.002, 0.0115);
  const Patch one = patchWithin(here, { center, 0.004, 250.0 }, 0.0);
  const Patch other =
    patchWithin(there, { center + Eigen::Vector3d(30.0, -20.0, 10.0), 0.004, 250.0 }, 0.0);
  EXPECT_NEAR(other.moment, one.moment, 1e-8 * one.moment);
  EXPECT_NEAR(other.solidAngle, one.solidAngle, 1e-8);
}

} // namespace
} // namespace palp
