#include "pipeline/deform/dent.h"

#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;
using test::DentedSurface;

constexpr double kFloat = 1e-7;  // [m] rounding of a coordinate of 0.3 m, twice
constexpr double kInside = 1e-6; // [m] allowed depth inside the tool

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

int zoneOf(const DentedSurface& surface, std::size_t i)
{
  return surface.zone[i];
}

double deepestInside(const DentedSurface& surface, const Press& press)
{
  const ToolBody body(press.tip, press.pose);
  double deepest = -1.0;
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    if (surface.zone[i] != 0)
    {
      deepest = std::max(deepest, body.inside(DentedSurface::at(surface.points, i)));
    }
  }
  return deepest;
}

class AnyTip : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, AnyTip,
  ::testing::Values(Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 45.0_deg, 10.0_mm } },
    Tip{ ConeTip{ 30.0_deg, 6.0_mm } }, Tip{ PunchTip{ 5.0_mm } }));

// on a plane, Fig. 5(b) to the letter: tool inside r, the curve of P0, P1, P2 up to R_d, rest
// beyond
TEST_P(AnyTip, OnAPlaneIsTheToolAndTheBezierRing)
{
  const double depth = 3.0_mm;
  const double extent = 20.0_mm;
  DentedSurface surface = test::plane(80, 0.75_mm);
  const Press press = test::pressAt({ 0.2_mm, 0.1_mm, 0.0 }, kUp, GetParam(), depth, extent);
  surface.press(press);

  const double r = press.contactRadius;
  const double sink = depth - tipHeight(GetParam(), r);
  const double slope = tipSlope(GetParam(), r * (1.0 - 1e-9));
  const double meet = slope > 0.0 ? r + sink / slope : r; // a flat punch ends in its vertical side
  const PatchNet net{ { { { { r, 0.0, -sink }, { r, 0.0, -sink } } },
    { { { meet, 0.0, 0.0 }, { meet, 0.0, 0.0 } } },
    { { { extent, 0.0, 0.0 }, { extent, 0.0, 0.0 } } } } };
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    const Eigen::Vector3d rest = DentedSurface::at(surface.rest, i);
    const double radius = (rest - press.contact.center).norm();
    double expected = 0.0;
    if (radius < r)
    {
      expected = tipHeight(GetParam(), radius) - depth;
    }
    else if (radius < extent)
    {
      double low = 0.0;
      double high = 1.0;
      for (int k = 0; k < 60; ++k)
      {
        const double u = 0.5 * (low + high);
        (patchPoint(net, u, 0.0).x() < radius ? low : high) = u;
      }
      expected = patchPoint(net, low, 0.0).z();
    }
    const Eigen::Vector3d drawn = DentedSurface::at(surface.points, i);
    EXPECT_NEAR(drawn.z(), expected, 5e-7) << "radius " << radius;
    EXPECT_EQ(drawn.x(), rest.x());
    EXPECT_EQ(drawn.y(), rest.y());
    EXPECT_EQ(zoneOf(surface, i), radius < r ? 2 : (radius < extent ? 1 : 0));
  }
}

// 5 mm of a sphere of R = 10 mm, as finite elements of a 50 mm block gave it
constexpr SurfaceProfile kFitted{ .inner = 6.78708_mm,
  .outer = 40.0_mm,
  .sink = 2.344_mm,
  .slope = 0.924157,
  .control = { 1.17259_mm, 1.21531_mm } };

TEST(Dent, FollowsAFittedSurfaceOnAPlane)
{
  DentedSurface surface = test::plane(100, 1.0_mm);
  Press press = test::pressAt({ 0.2_mm, 0.1_mm, 0.0 }, kUp, SphereTip{ 10.0_mm }, 5.0_mm, 18.4_mm);
  press.fitted = kFitted;
  surface.press(press);
  for (std::size_t i = 0; i < surface.count(); ++i)
  {
    const Eigen::Vector3d rest = DentedSurface::at(surface.rest, i);
    const double radius = (rest - press.contact.center).norm();
    const double expected =
      radius <= kFitted.inner ? 5.0_mm - tipHeight(press.tip, radius) : kFitted.sinkAt(radius);
    // the table has five digits, and its tool is met at its own radius
    EXPECT_NEAR(-DentedSurface::at(surface.points, i).z(), expected, 5.0_um) << radius;
  }
  EXPECT_LE(deepestInside(surface, press), kInside);
}

TEST(Dent, IsTheExactRestStateAgainOnRelease)
{
  DentedSurface surface = test::ellipsoid(5, { 50.0_mm, 40.0_mm, 30.0_mm });
  const auto points = surface.points;
  const auto normals = surface.normals;
  EXPECT_EQ(points, surface.rest);
  for (const double x : { 0.0, 5.0_mm, -20.0_mm })
  {
    surface.press(test::pressAt({ x, 0.0, 30.0_mm }, kUp, SphereTip{ 10.0_mm }, 4.0_mm, 15.0_mm));
    EXPECT_NE(surface.points, points);
  }
  surface.press(Press{});
  EXPECT_EQ(surface.points, points);
  EXPECT_EQ(surface.normals, normals);
  EXPECT_EQ(surface.displacement, std::vector<float>(points.size(), 0.0F));
  EXPECT_EQ(surface.zone, std::vector<unsigned char>(surface.count(), 0));
  EXPECT_TRUE(surface.dent.region().points().empty());
}

TEST(Dent, DoesNotDependOnThePressBefore)
{
  DentedSurface direct = test::ellipsoid(5, { 50.0_mm, 40.0_mm, 30.0_mm });
  DentedSurface moved = test::ellipsoid(5, { 50.0_mm, 40.0_mm, 30.0_mm });
  const Press last =
    test::pressAt({ 0.0, 0.0, 30.0_mm }, kUp, SphereTip{ 10.0_mm }, 4.0_mm, 15.0_mm);
  moved.press(test::pressAt({ 8.0_mm, 0.0, 29.0_mm }, kUp, SphereTip{ 10.0_mm }, 6.0_mm, 20.0_mm));
  moved.press(last);
  direct.press(last);
  EXPECT_EQ(moved.points, direct.points);
  EXPECT_EQ(moved.normals, direct.normals);
}

TEST(Dent, TakesNoHarmFromValuesThatAreNotFinite)
{
  DentedSurface surface = test::plane(20, 2.0_mm);
  const auto rest = surface.points;
  Press press = test::pressAt(Eigen::Vector3d::Zero(), kUp, SphereTip{ 10.0_mm }, 2.0_mm, 10.0_mm);
  press.contact.center.x() = std::numeric_limits<double>::quiet_NaN();
  surface.press(press);
  EXPECT_EQ(surface.points, rest);
  press = test::pressAt(Eigen::Vector3d::Zero(), kUp, SphereTip{ 10.0_mm }, 2.0_mm, 10.0_mm);
  press.pose.axis.setConstant(std::numeric_limits<double>::quiet_NaN());
  surface.press(press);
  for (const float value : surface.points)
  {
    EXPECT_TRUE(std::isfinite(value));
  }
}

// a device may turn the tool any way
TEST(Dent, IsFiniteHoweverTheToolIsTurned)
{
  DentedSurface surface = test::plane(40, 2.0_mm);
  for (const Tip& tip : { Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 45.0_deg, 10.0_mm } },
         Tip{ PunchTip{ 5.0_mm } }, Tip{ ParaboloidTip{ 10.0_mm } } })
  {
    for (const double tilt : { 60.0_deg, 89.99_deg, 90.0_deg, 110.0_deg, 180.0_deg })
    {
      Press press = test::pressAt(Eigen::Vector3d::Zero(), kUp, tip, 3.0_mm, 15.0_mm);
      press.pose.axis = Eigen::Vector3d(std::sin(tilt), 0.0, -std::cos(tilt));
      surface.press(press);
      const auto isFinite = [](float x) { return std::isfinite(x); };
      for (const auto* values : { &surface.points, &surface.normals, &surface.displacement })
      {
        EXPECT_TRUE(std::all_of(values->begin(), values->end(), isFinite))
          << "tip " << tip.index() << " at " << units::toDegrees(tilt);
      }
    }
  }
}

// The wall beside a punch begins at its rim, on the high side of a tilted one as on a straight one:
// one contact radius further out the surface has risen by more than half.
TEST(Dent, LeavesATiltedPunchAtItsRim)
{
  DentedSurface surface = test::plane(160, 0.5_mm);
  const double depth = 8.0_mm;
  Press press = test::pressAt(Eigen::Vector3d::Zero(), kUp, PunchTip{ 5.0_mm }, depth, 15.0_mm);
  for (const double tilt : { 0.0_deg, 10.0_deg })
  {
    press.pose.axis = Eigen::Vector3d(std::sin(tilt), 0.0, -std::cos(tilt));
    surface.press(press);
    for (std::size_t i = 0; i < surface.count(); ++i)
    {
      const Eigen::Vector3d rest = DentedSurface::at(surface.rest, i);
      if (std::abs(rest.norm() - 10.0_mm) < 0.25_mm)
      {
        EXPECT_GT(DentedSurface::at(surface.points, i).z(), -0.5 * depth) << rest.transpose();
      }
    }
  }
}

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

// where edges are longer than the contact is wide, a point in the tool may be no neighbour of one
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
  std::uniform_real_distribution<double> share(0.05, 1.0);
  std::uniform_real_distribution<double> tilt(-20.0_deg, 20.0_deg);
  const std::vector<float> restNormals = surface.normals;
  const std::array<Tip, 3> tips{ SphereTip{ 10.0_mm }, SphereTip{ 4.0_mm },
    ConeTip{ 45.0_deg, 10.0_mm } };
  for (int i = 0; i < 70; ++i)
  {
    const std::size_t at = vertex(random);
    const Eigen::Vector3d normal = DentedSurface::at(restNormals, at).normalized();
    const Tip& tip = tips[static_cast<std::size_t>(i) % tips.size()];
    const double depth = share(random) * 0.5 * baseRadius(tip);
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
  std::uniform_real_distribution<double> share(0.05, 1.0);
  const std::vector<float> restNormals = surface.normals;
  for (int i = 0; i < 70; ++i)
  {
    const std::size_t at = vertex(random);
    const Eigen::Vector3d normal = DentedSurface::at(restNormals, at).normalized();
    const double depth = share(random) * 5.0_mm;
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

TEST(Dent, DoesNotAllocateOnceItHasSeenSuchADent)
{
  DentedSurface surface = test::ellipsoid(5, { 50.0_mm, 40.0_mm, 30.0_mm });
  const auto frame = [&](int i)
  {
    const double x = 2.0_mm * std::sin(0.3 * i);
    const Eigen::Vector3d top(x, 0.0, 30.0_mm);
    surface.press(
      test::pressAt(top, kUp, SphereTip{ 10.0_mm }, 3.0_mm + 1.0_mm * std::sin(0.7 * i), 15.0_mm));
  };
  for (int i = 0; i < 100; ++i)
  {
    frame(i);
  }
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i)
  {
    frame(i);
  }
  EXPECT_EQ(guard.count(), 0);
}

TEST(Dent, NeedsLessMemoryThanThreeTimesThePoints)
{
  const DentedSurface surface = test::ellipsoid(5, { 50.0_mm, 50.0_mm, 50.0_mm });
  EXPECT_LE(surface.dent.bytes(), 3 * surface.rest.size() * sizeof(float));
}

} // namespace
} // namespace palp
