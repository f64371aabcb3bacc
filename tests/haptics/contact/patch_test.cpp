#include "haptics/contact/patch.h"

#include "tests/support/surfaces.h"

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
    return { .area = value > 0.0 ? area : 0.0, .weight = value > 0.0 ? area * value : 0.0 };
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
    sum.area += value.area;
    sum.weight += value.weight;
  }
  return sum;
}

TEST(Patch, TriangleAndBallAgreeWithSubdivision)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto point = [&] { return Eigen::Vector3d(place(random), place(random), place(random)); };
  for (int i = 0; i < 200; ++i)
  {
    const Facet facet = facetOf(point(), point(), point());
    const Eigen::Vector3d center = point();
    const double squaredRadius = 0.05 + std::abs(place(random));
    const DiscIntegral exact = integrate(facet, center, squaredRadius);
    const DiscIntegral sum = subdivided(facet, center, squaredRadius, 7);
    EXPECT_NEAR(exact.area, sum.area, 5e-3);
    EXPECT_NEAR(exact.weight, sum.weight, 5e-4);
  }
}

TEST(Patch, WholeDiscInsideATriangle)
{
  const Facet facet = facetOf({ -9.0, -9.0, 0.0 }, { 9.0, -9.0, 0.0 }, { 0.0, 9.0, 0.0 });
  const DiscIntegral disc = integrate(facet, { 0.1, 0.2, 0.6 }, 1.0);
  EXPECT_NEAR(disc.area, std::numbers::pi * 0.64, 1e-14);
  EXPECT_NEAR(disc.weight, 0.5 * std::numbers::pi * 0.64 * 0.64, 1e-14);
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
      EXPECT_NEAR(patch.area, std::numbers::pi * disc, 1e-12);
      EXPECT_NEAR(patch.weight, 0.5 * std::numbers::pi * disc * disc, 1e-12);
      EXPECT_NEAR(patch.normal.z(), patch.weight, 1e-12);
    }
  }
}

// the claim the depth rests on: h^2 = Q - 2 weight / area on a sphere of any radius, either side
TEST(Patch, DistanceToASphereFollowsFromAreaAndWeight)
{
  const double height = 0.3;
  for (const double bodyRadius : { 0.7, 2.0, 50.0 })
  {
    const Surface body = test::makeSurface(test::ball(bodyRadius, 300));
    const Eigen::Vector3d center =
      (bodyRadius + height) * Eigen::Vector3d(1.0, 2.0, 3.0).normalized();
    const double radius = bodyRadius < 1.0 ? 0.6 : 1.0;
    const Patch patch = patchWithin(body, center, radius, 1.0, 1.0);
    const double h = std::sqrt(radius * radius - 2.0 * patch.weight / patch.area);
    EXPECT_NEAR(h, height, 2e-3 * (bodyRadius > 10.0 ? 3.0 : 1.0));
  }
}

} // namespace
} // namespace palp
