#include "haptics/contact/patch.h"

#include "tests/support/surfaces.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

Facet facetOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return { .corners = { a, b, c }, .normal = (b - a).cross(c - a).normalized() };
}

// the same integrals by halving the triangle again and again
DiscIntegral subdivided(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius, int levels)
{
  const auto& [a, b, c] = facet.corners;
  if (levels == 0)
  {
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const double value = squaredRadius - ((a + b + c) / 3.0 - center).squaredNorm();
    const double inside = std::max(0.0, value);
    return { .weight = area * inside, .square = area * inside * inside };
  }
  const Eigen::Vector3d ab = 0.5 * (a + b);
  const Eigen::Vector3d bc = 0.5 * (b + c);
  const Eigen::Vector3d ca = 0.5 * (c + a);
  DiscIntegral sum;
  for (const Facet& part :
    { Facet{ { a, ab, ca }, facet.normal }, Facet{ { ab, b, bc }, facet.normal },
      Facet{ { ca, bc, c }, facet.normal }, Facet{ { ab, bc, ca }, facet.normal } })
  {
    const DiscIntegral value = subdivided(part, center, squaredRadius, levels - 1);
    sum.weight += value.weight;
    sum.square += value.square;
  }
  return sum;
}

TEST(Patch, TriangleAndBallAgreeWithSubdivision)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> position(-1.0, 1.0);
  const auto point = [&]
  { return Eigen::Vector3d(position(random), position(random), position(random)); };
  for (int i = 0; i < 200; ++i)
  {
    const Facet facet = facetOf(point(), point(), point());
    const Eigen::Vector3d center = point();
    const double squaredRadius = 0.05 + std::abs(position(random));
    const DiscIntegral exact = integrate(facet, center, squaredRadius);
    const DiscIntegral sum = subdivided(facet, center, squaredRadius, 7);
    EXPECT_NEAR(exact.weight, sum.weight, 5e-4);
    EXPECT_NEAR(exact.square, sum.square, 5e-4);
  }
}

// a tool a thousand times as large as the triangles: sums over its disc would be all rounding
TEST(Patch, ATriangleAndAFarLargerBallAgreeWithSubdivision)
{
  const Facet facet = facetOf({ 0.0, 0.0, 0.0 }, { 1e-3, 0.0, 2e-4 }, { 3e-4, 1e-3, 0.0 });
  const Eigen::Vector3d center(0.2, -0.1, 1.0);
  const double nearest = (facet.corners[1] - center).norm();
  for (const double reach : { 1e-5, 5e-5, 1e-4, 1.5e-4, 2e-4, 1e-3 })
  {
    const double squaredRadius = (nearest + reach) * (nearest + reach);
    const DiscIntegral exact = integrate(facet, center, squaredRadius);
    const DiscIntegral sum = subdivided(facet, center, squaredRadius, 9);
    EXPECT_NEAR(exact.weight, sum.weight, 3e-3 * sum.weight);
    EXPECT_NEAR(exact.square, sum.square, 3e-3 * sum.square);
  }
}

TEST(Patch, WholeDiscInsideATriangle)
{
  const Facet facet = facetOf({ -9.0, -9.0, 0.0 }, { 9.0, -9.0, 0.0 }, { 0.0, 9.0, 0.0 });
  const DiscIntegral disc = integrate(facet, { 0.1, 0.2, 0.6 }, 1.0);
  EXPECT_NEAR(disc.weight, std::numbers::pi * std::pow(0.64, 2) / 2.0, 1e-14);
  EXPECT_NEAR(disc.square, std::numbers::pi * std::pow(0.64, 3) / 3.0, 1e-14);
}

// however a plane is cut into triangles, the parts add up to the disc
TEST(Patch, TrianglesOfAPlaneAddUpToTheDisc)
{
  for (const int n : { 2, 7, 40, 173 })
  {
    const Surface plane = test::makeSurface(test::sheet(8.0, n));
    for (const Eigen::Vector3d& center : { Eigen::Vector3d(0.0, 0.0, 0.5),
           Eigen::Vector3d(0.37, -1.1, 0.9), Eigen::Vector3d(1.0, 1.0, -0.2) })
    {
      const double disc = 1.21 - center.z() * center.z();
      const Patch patch = patchWithin(plane, center, 1.1, std::copysign(1.0, center.z()), 1.0);
      EXPECT_NEAR(patch.weight, std::numbers::pi * disc * disc / 2.0, 1e-12);
      EXPECT_NEAR(patch.square.z(), std::numbers::pi * disc * disc * disc / 3.0, 1e-12);
      EXPECT_NEAR(patch.normal.z(), patch.weight, 1e-12);
    }
  }
}

// The claim the depth rests on: h^2 = Q - 3/2 square / weight on a sphere of any radius. Along the
// mean normal, a ball about a body's whole side (0.6 about one of radius
// 0.7) is no such part of it.
TEST(Patch, DistanceToASphereFollowsFromWeightAndSquare)
{
  const double height = 0.3;
  for (const double bodyRadius : { 0.7, 2.0, 50.0 })
  {
    const Surface body = test::makeSurface(test::ball(bodyRadius, 300));
    const Eigen::Vector3d center =
      (bodyRadius + height) * Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
    const double radius = bodyRadius < 1.0 ? 0.4 : bodyRadius < 10.0 ? 0.6 : 1.0;
    const Patch patch = patchWithin(body, center, radius, 1.0, 1.0);
    const double h = std::sqrt(radius * radius - 1.5 * patch.square.norm() / patch.normal.norm());
    EXPECT_NEAR(h, height, 2e-3 * (bodyRadius > 10.0 ? 3.0 : 1.0));
  }
}

// both are gentle where a triangle leaves the ball: what is left of one that faces the center
// shrinks as the square and the cube of what the ball still reaches beyond it
TEST(Patch, ATriangleLeavesTheBallGently)
{
  const Facet facet = facetOf({ -9.0, -9.0, 0.0 }, { 9.0, -9.0, 0.0 }, { 0.0, 9.0, 0.0 });
  for (const double reach : { 1e-2, 1e-4, 1e-6 })
  {
    const DiscIntegral last = integrate(facet, { 0.0, 0.0, 1.0 }, 1.0 + reach);
    EXPECT_NEAR(last.weight, std::numbers::pi * reach * reach / 2.0, 1e-9 * reach);
    EXPECT_NEAR(last.square, std::numbers::pi * std::pow(reach, 3) / 3.0, 1e-9 * reach * reach);
  }
}

} // namespace
} // namespace palp
