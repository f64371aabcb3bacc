#include "pipeline/deform/dent.h"

#include "haptics/units.h"
#include "tests/pipeline/deform/inside_tool.h"
#include "tests/pipeline/surfaces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

// pressed near its edge the lobe bends around it, but a point of the other side that is farther
// away than R_d over the edge does not move, though it lies 4 mm below the tool
TEST(Dent, FarSideOfAThinLobeStaysPut)
{
  DentedSurface surface = test::ellipsoid(5, { 60.0_mm, 40.0_mm, 2.0_mm });
  const Press press =
    test::pressAt({ 0.0, 0.0, 2.0_mm }, kUp, SphereTip{ 10.0_mm }, 1.5_mm, 20.0_mm);
  surface.press(press);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    moved += surface.zone[i] != 0 ? 1 : 0;
    if (DentedSurface::at(surface.rest, i).z() < 0.0)
    {
      EXPECT_EQ(surface.zone[i], 0);
      EXPECT_EQ(DentedSurface::at(surface.points, i), DentedSurface::at(surface.rest, i));
    }
  }
  EXPECT_GT(moved, 100U);
}

TEST(Dent, ReachesAroundAnEdgeByTheWayAlongTheSurface)
{
  DentedSurface surface = test::ellipsoid(5, { 60.0_mm, 40.0_mm, 2.0_mm });
  // 10 mm from the edge, R_d = 14 mm: the far side is reached for about 4 mm
  const double y = 30.0_mm;
  const double z = 2.0_mm * std::sqrt(1.0 - y * y / (40.0_mm * 40.0_mm));
  const Eigen::Vector3d normal =
    Eigen::Vector3d(0.0, y / (40.0_mm * 40.0_mm), z / (2.0_mm * 2.0_mm)).normalized();
  surface.press(test::pressAt({ 0.0, y, z }, normal, SphereTip{ 5.0_mm }, 0.5_mm, 14.0_mm));
  double nearest = 1.0;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    const Eigen::Vector3d rest = DentedSurface::at(surface.rest, i);
    if (rest.z() < -0.1_mm && surface.zone[i] != 0)
    {
      nearest = std::min(nearest, rest.y());
    }
  }
  EXPECT_NEAR(nearest, 36.0_mm, 1.5_mm);
}

// where edges are longer than the contact is wide, a point in the tool may be no neighbor of one
// that moves
TEST(Dent, FindsEveryPointInTheToolOnARoughCoarseSurface)
{
  DentedSurface rough = test::plane(30, 2.3_mm);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> by(-1.2_mm, 1.2_mm);
  for (std::size_t i = 0; i < rough.count(); ++i)
  {
    rough.rest[3 * i + 2] = static_cast<float>(by(random));
  }
  const DentedSurface shape = rough;
  DentedSurface surface;
  surface.rest = shape.rest;
  surface.triangles = shape.triangles;
  surface.finish();
  for (const Tip& tip :
    { Tip{ BluntConeTip{ 45.0_deg, 2.0_mm, 10.0_mm } }, Tip{ SphereTip{ 4.0_mm } },
      Tip{ ConeTip{ 60.0_deg, 6.0_mm } }, Tip{ PunchTip{ 3.0_mm } } })
  {
    for (int i = 0; i < 300; ++i)
    {
      const Press press = test::pressAt({ by(random), by(random), 0.0 }, kUp, tip, 1.26_mm, 0.0);
      surface.press(press);
      for (std::size_t k = 0; k < surface.count(); ++k)
      {
        // by the tip's own profile
        const Eigen::Vector3d from = DentedSurface::at(surface.points, k) - press.pose.apex;
        const double radius = from.head<2>().norm();
        const double inside = std::min(from.z() - tipHeight(tip, radius), baseRadius(tip) - radius);
        ASSERT_LE(inside, kInside) << "tip " << tip.index() << ", press " << i;
      }
    }
  }
}

TEST(Dent, MeetsTheEdgeOfAnOpenSurface)
{
  DentedSurface surface = test::plane(40, 1.0_mm);
  const Press press =
    test::pressAt({ 19.0_mm, 0.0, 0.0 }, kUp, SphereTip{ 10.0_mm }, 4.0_mm, 15.0_mm);
  surface.press(press);
  EXPECT_LE(deepestInside(surface, press), kInside);
  EXPECT_TRUE(std::count(surface.zone.begin(), surface.zone.end(), 2) > 20);
}

// random presses over a round, a flat and a slender body
class RandomPress : public ::testing::TestWithParam<Eigen::Vector3d>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, RandomPress,
  ::testing::Values(Eigen::Vector3d(50.0_mm, 50.0_mm, 50.0_mm),
    Eigen::Vector3d(80.0_mm, 60.0_mm, 30.0_mm), Eigen::Vector3d(100.0_mm, 25.0_mm, 20.0_mm)));

TEST_P(RandomPress, KeepsEveryPointOutOfTheToolAndBeyondRdAtRest)
{
  DentedSurface surface = test::ellipsoid(5, GetParam());
  std::mt19937 random(11);
  std::uniform_int_distribution<std::size_t> vertex(0, surface.count() - 1);
  std::uniform_real_distribution<double> fraction(0.05, 1.0);
  std::uniform_real_distribution<double> tilt(-20.0_deg, 20.0_deg);
  const std::vector<float> restNormals = surface.normals;
  const std::array<Tip, 3> tips{ SphereTip{ 10.0_mm }, SphereTip{ 4.0_mm },
    ConeTip{ 45.0_deg, 10.0_mm } };
  for (int i = 0; i < 70; ++i)
  {
    const std::size_t at = vertex(random);
    const Eigen::Vector3d normal = DentedSurface::at(restNormals, at).normalized();
    const Tip& tip = tips[static_cast<std::size_t>(i) % tips.size()];
    const double depth = fraction(random) * 0.5 * baseRadius(tip);
    const double extent = 3.7 * depth;
    Press press = test::pressAt(DentedSurface::at(surface.rest, at), normal, tip, depth, extent);
    if (const auto* sphere = std::get_if<SphereTip>(&tip))
    {
      // a sphere may lean without a change of its lowest point
      const Eigen::Vector3d middle = press.pose.apex + sphere->radius * normal;
      press.pose.axis = Eigen::AngleAxisd(tilt(random), normal.unitOrthogonal()) * press.pose.axis;
      press.pose.apex = middle + sphere->radius * press.pose.axis;
    }
    surface.press(press);
    EXPECT_LE(deepestInside(surface, press), kInside) << "press " << i;
    const double ring = surface.dent.region().outer();
    for (std::size_t k = 0; k < surface.count(); ++k)
    {
      const Eigen::Vector3d rest = DentedSurface::at(surface.rest, k);
      if ((rest - press.contact.center).norm() > ring)
      {
        ASSERT_EQ(DentedSurface::at(surface.points, k), rest) << "press " << i;
      }
      ASSERT_NEAR(DentedSurface::at(surface.normals, k).norm(), 1.0, 1e-6);
    }
  }
}

TEST_P(RandomPress, TurnsNoTriangleOver)
{
  DentedSurface surface = test::ellipsoid(5, GetParam());
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> vertex(0, surface.count() - 1);
  std::uniform_real_distribution<double> fraction(0.05, 1.0);
  const std::vector<float> restNormals = surface.normals;
  for (int i = 0; i < 70; ++i)
  {
    const std::size_t at = vertex(random);
    const Eigen::Vector3d normal = DentedSurface::at(restNormals, at).normalized();
    const double depth = fraction(random) * 5.0_mm;
    surface.press(test::pressAt(
      DentedSurface::at(surface.rest, at), normal, SphereTip{ 10.0_mm }, depth, 3.7 * depth));
    for (const Triangle& triangle : surface.triangles)
    {
      const auto area = [&](const std::vector<float>& of)
      {
        const Eigen::Vector3d a = DentedSurface::at(of, static_cast<std::size_t>(triangle[0]));
        const Eigen::Vector3d b = DentedSurface::at(of, static_cast<std::size_t>(triangle[1]));
        const Eigen::Vector3d c = DentedSurface::at(of, static_cast<std::size_t>(triangle[2]));
        return Eigen::Vector3d((b - a).cross(c - a));
      };
      ASSERT_GT(area(surface.points).dot(area(surface.rest)), 0.0) << "press " << i;
    }
  }
}

} // namespace
} // namespace palp
