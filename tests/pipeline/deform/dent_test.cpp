#include "pipeline/deform/dent.h"

#include "haptics/units.h"
#include "tests/pipeline/deform/inside_tool.h"
#include "tests/pipeline/surfaces.h"
#include "tests/support/allocation_guard.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace test;
using namespace units::literals;

int zoneOf(const DentedSurface& surface, std::size_t i)
{
  return surface.zone[i];
}

class AnyTip : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(Dent, AnyTip,
  ::testing::Values(Tip{ SphereTip{ 10.0_mm } }, Tip{ ConeTip{ 45.0_deg, 10.0_mm } },
    Tip{ ConeTip{ 30.0_deg, 6.0_mm } }, Tip{ PunchTip{ 5.0_mm } }));

// on a plane, Fig. 5(b) to the letter: tool inside r, the curve of P0,
// P1, P2 up to R_d, rest beyond
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

// the same dent about the place where the tissue in contact was at rest, carried to the tool
TEST(Dent, IsCarriedAlongByFriction)
{
  const Eigen::Vector3d carried(1.2_mm, 0.0, 0.0);
  Press press = test::pressAt({ 0.2_mm, 0.1_mm, 0.0 }, kUp, SphereTip{ 10.0_mm }, 3.0_mm, 20.0_mm);
  DentedSurface dragged = test::plane(80, 0.75_mm);
  press.carried = carried;
  dragged.press(press);
  Press before = press;
  before.carried.setZero();
  before.contact.center -= carried;
  before.pose.apex -= carried;
  DentedSurface still = test::plane(80, 0.75_mm);
  still.press(before);
  for (std::size_t i = 0; i < dragged.count(); ++i)
  {
    const Eigen::Vector3d rest = DentedSurface::at(dragged.rest, i);
    const Eigen::Vector3d drawn = DentedSurface::at(dragged.points, i);
    const double radius = (rest - before.contact.center).norm();
    const Eigen::Vector3d aside = drawn - DentedSurface::at(still.points, i);
    EXPECT_EQ(zoneOf(dragged, i), zoneOf(still, i));
    EXPECT_NEAR(aside.y(), 0.0, 1e-8);
    EXPECT_NEAR(aside.z(), 0.0, 1e-7);
    EXPECT_LE(aside.x(), carried.x() + 1e-8);
    if (radius < press.contactRadius) // and so lies on the tool
    {
      EXPECT_NEAR(aside.x(), carried.x(), 1e-7);
      const double across = (drawn - press.contact.center).head<2>().norm();
      EXPECT_NEAR(drawn.z(), tipHeight(press.tip, across) - 3.0_mm, 1e-6);
    }
    else if (radius > 20.0_mm)
    {
      EXPECT_EQ(drawn, rest);
    }
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

// straight down with a flat end askew, whose edges go in one after the other
TEST(Dent, ComesUpNowhereAsATiltedFlatSinks)
{
  for (const Tip& tip :
    { Tip(TruncatedConeTip{ 40.0_deg, 2.0_mm, 9.0_mm }), Tip(PunchTip{ 3.0_mm }) })
  {
    for (double tilt = 4.0_deg; tilt < 25.0_deg; tilt += 4.0_deg)
    {
      DentedSurface surface = test::plane(60, 0.5_mm);
      std::vector<float> before = surface.displacement;
      std::vector<unsigned char> zones = surface.zone;
      for (double depth = 0.1_mm; depth < 3.0_mm; depth += 0.02_mm)
      {
        Press press = test::pressAt(Eigen::Vector3d::Zero(), kUp, tip, depth, 8.0_mm);
        press.contact.tilt = tilt;
        press.pose.apex.z() += flatRadius(tip) * std::sin(tilt); // the lowest edge is at the depth
        press.pose.axis = { std::sin(tilt), 0.0, -std::cos(tilt) };
        surface.press(press);
        for (std::size_t i = 0; i < surface.count(); ++i)
        {
          const double change =
            DentedSurface::at(before, i).z() - DentedSurface::at(surface.displacement, i).z();
          ASSERT_TRUE(change > -1.0_um || surface.zone[i] == 2 || zones[i] == 2)
            << depth << " at " << DentedSurface::at(surface.rest, i).transpose() << ": " << change;
        }
        before = surface.displacement;
        zones = surface.zone;
      }
    }
  }
}

// a point of a scan that lies low stays down with its neighbors until the contact has reached it
TEST(Dent, LiftsNoLowPointBeforeTheContactIsThere)
{
  const DentedSurface flat = test::plane(60, 0.5_mm);
  DentedSurface surface;
  std::vector<std::size_t> low;
  for (std::size_t i = 0; i < flat.count(); ++i)
  {
    const Eigen::Vector3d at = DentedSurface::at(flat.rest, i);
    const bool isLow = i % 7 == 0 && at.norm() > 1.0_mm && at.norm() < 5.0_mm;
    surface.add(at - (isLow ? 0.1_mm : 0.0) * kUp);
    if (isLow)
    {
      low.push_back(i);
    }
  }
  surface.triangles = flat.triangles;
  surface.finish();
  ASSERT_GT(low.size(), 20U);
  std::vector<float> before = surface.displacement;
  for (double depth = 0.02_mm; depth < 2.0_mm; depth += 0.02_mm)
  {
    surface.press(test::pressAt(Eigen::Vector3d::Zero(), kUp, SphereTip{ 10.0_mm }, depth, 8.0_mm));
    for (const std::size_t i : low)
    {
      const double change =
        DentedSurface::at(before, i).z() - DentedSurface::at(surface.displacement, i).z();
      EXPECT_TRUE(surface.zone[i] == 2 || change > -1.0_um)
        << depth << " at " << DentedSurface::at(surface.rest, i).transpose() << ": " << change;
    }
    before = surface.displacement;
  }
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
