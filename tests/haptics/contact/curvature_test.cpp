#include "haptics/contact/curvature.h"

#include "tests/support/surfaces.h"

#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

// seen at the middle of each triangle that is away from the edge of the sheet
template <typename Check>
void atTriangles(const Surface& surface, double edge, Check check)
{
  for (int i = 0; i < static_cast<int>(surface.triangles().size()); ++i)
  {
    const Triangle& t = surface.triangles()[static_cast<std::size_t>(i)];
    const auto point = [&](std::size_t k) -> const Eigen::Vector3d&
    { return surface.points()[static_cast<std::size_t>(t[k])]; };
    const Eigen::Vector3d middle = (point(0) + point(1) + point(2)) / 3.0;
    const Eigen::Vector3d normal = (point(1) - point(0)).cross(point(2) - point(0)).normalized();
    if (surface.edgeDistance(middle, i) > edge)
    {
      check(surface.curvature(middle, i, normal));
    }
  }
}

// at an irregular point the normal is off by a share of an edge, and so is the curvature
TEST(Curvature, OfASphereIsOneOverItsRadius)
{
  for (const double radius : { 0.03, 0.1 })
  {
    for (const int n : { 8, 30 })
    {
      double sum = 0.0;
      int count = 0;
      atTriangles(test::makeSurface(test::ball(radius, n)), 0.0,
        [&](const Curvature& here)
        {
          EXPECT_NEAR(here.mean, 1.0 / radius, 0.06 / radius);
          EXPECT_LT(here.spread, 0.06 / radius);
          sum += here.mean;
          ++count;
        });
      EXPECT_NEAR(sum / count, 1.0 / radius, 0.02 / radius);
    }
  }
}

TEST(Curvature, OfAPlaneIsNone)
{
  atTriangles(test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, 1)), 0.0,
    [](const Curvature& here) { EXPECT_TRUE(std::isfinite(here.mean)); });
  atTriangles(test::makeSurface(test::sheet(0.1, 9)), -1.0,
    [](const Curvature& here)
    {
      EXPECT_EQ(here.mean, 0.0);
      EXPECT_EQ(here.spread, 0.0);
    });
}

// z = -(a x^2 + b y^2) / 2 has the principal curvatures a and b at its middle
TEST(Curvature, OfAQuadricIsThatOfItsAxes)
{
  for (const auto& [a, b] :
    { std::pair(20.0, 0.0), std::pair(20.0, 10.0), std::pair(15.0, -15.0), std::pair(-12.0, -6.0) })
  {
    const Surface sheet = test::makeSurface(test::sheet(
      0.02, 41, [a = a, b = b](double x, double y) { return -0.5 * (a * x * x + b * y * y); }));
    atTriangles(sheet, 0.007,
      [&](const Curvature& here)
      {
        EXPECT_NEAR(here.mean, 0.5 * (a + b), 0.3);
        EXPECT_NEAR(here.spread, 0.5 * std::abs(a - b), 0.3);
      });
  }
}

} // namespace
} // namespace palp
