#include "calibration/organ/organ_compliance.h"
#include "calibration/organ/organ_places.h"
#include "data/shapes.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

// an outline of convex corners in turn, drawn out along y; caps: quadrilaterals of its corners
Surface drawnOut(const std::vector<std::pair<double, double>>& outline,
  const std::vector<std::array<int, 4>>& caps, double width)
{
  Mesh mesh;
  const auto count = static_cast<int>(outline.size());
  for (const double y : { 0.0, width })
  {
    for (const auto& [x, z] : outline)
    {
      mesh.points.emplace_back(x, y, z);
    }
  }
  const auto add = [&](int a, int b, int c, int d)
  {
    mesh.triangles.push_back({ a, b, c });
    mesh.triangles.push_back({ a, c, d });
  };
  for (const auto& [a, b, c, d] : caps)
  {
    add(a, b, c, d);
    add(count + d, count + c, count + b, count + a);
  }
  for (int i = 0; i < count; ++i)
  {
    const int next = (i + 1) % count;
    add(next, i, count + i, count + next);
  }
  return Surface(mesh.points, mesh.triangles);
}

// By finite elements a lobe over a slit of 2 mm was 10 times too stiff by cells of 4 mm, which glue
// its lips, and 12 mm beside one that goes 25 mm down it was 10 % so; by cells of 2 mm right.
TEST(OrganPlaces, AreNotTrustedAboveOrBesideAGapOfLessThanACell)
{
  const Support base{ [](const Vector3d& x) { return x.z() < -39.9_mm; } };
  const std::span supports(&base, 1);
  const auto isTold = [&](const Surface& surface, double x, double cell)
  {
    EXPECT_TRUE(surface.closed());
    return isTooThin({ { x, 30.0_mm, 0.0 }, Vector3d::UnitZ() }, surface, cell, supports,
      narrowGaps(surface, cell));
  };
  for (const double gap : { 0.5_mm, 2.0_mm, 5.0_mm })
  {
    const double low = -16.0_mm - gap;
    const Surface lying =
      drawnOut({ { 0.0, -40.0_mm }, { 80.0_mm, -40.0_mm }, { 80.0_mm, 0.0 }, { 0.0, 0.0 },
                 { 0.0, -16.0_mm }, { 50.0_mm, -16.0_mm }, { 50.0_mm, low }, { 0.0, low } },
        { { 0, 1, 6, 7 }, { 1, 2, 5, 6 }, { 2, 3, 4, 5 } }, 60.0_mm);
    EXPECT_TRUE(isTold(lying, 15.0_mm, 4.0_mm)) << gap;
    EXPECT_TRUE(isTold(lying, 30.0_mm, 4.0_mm)) << gap;
    EXPECT_FALSE(isTold(lying, 72.0_mm, 4.0_mm)) << gap;
    EXPECT_EQ(isTold(lying, 15.0_mm, 2.0_mm), gap < 2.5_mm) << gap;
    const double right = 40.0_mm + gap;
    const Surface standing =
      drawnOut({ { 0.0, -40.0_mm }, { 80.0_mm, -40.0_mm }, { 80.0_mm, 0.0 }, { right, 0.0 },
                 { right, -25.0_mm }, { 40.0_mm, -25.0_mm }, { 40.0_mm, 0.0 }, { 0.0, 0.0 } },
        { { 0, 1, 4, 5 }, { 1, 2, 3, 4 }, { 0, 5, 6, 7 } }, 60.0_mm);
    EXPECT_TRUE(isTold(standing, 28.0_mm, 4.0_mm)) << gap;
    EXPECT_TRUE(isTold(standing, 32.0_mm, 4.0_mm)) << gap;
    EXPECT_FALSE(isTold(standing, 15.0_mm, 4.0_mm)) << gap;
  }
  const Surface none =
    drawnOut({ { 0.0, -40.0_mm }, { 80.0_mm, -40.0_mm }, { 80.0_mm, 0.0 }, { 0.0, 0.0 } },
      { { 0, 1, 2, 3 } }, 60.0_mm);
  EXPECT_FALSE(isTold(none, 15.0_mm, 4.0_mm));
}

// A wall on a slab gives way as if a second one beside it were not there. Both are rooted in the
// slab, a gap apart that is wider than a cell; nodes of cubes in which both end joined them by
// +84 %, and by +57 % turned in the grid.
TEST(OrganModel, DoesNotJoinWhatAGapParts)
{
  const Support base{ [](const Vector3d& x) { return x.z() < -19.9_mm; } };
  for (const auto& [gap, cell] : { std::pair(6.0_mm, 4.0_mm), std::pair(9.0_mm, 6.0_mm) })
  {
    const double right = 25.0_mm + gap;
    const double end = 50.0_mm + gap;
    const Surface alone =
      drawnOut({ { 0.0, -20.0_mm }, { 25.0_mm, -20.0_mm }, { right, -20.0_mm }, { end, -20.0_mm },
                 { end, 0.0 }, { right, 0.0 }, { 25.0_mm, 0.0 }, { 25.0_mm, 40.0_mm },
                 { 0.0, 40.0_mm }, { 0.0, 0.0 } },
        { { 0, 1, 6, 9 }, { 1, 2, 5, 6 }, { 2, 3, 4, 5 }, { 6, 7, 8, 9 } }, 60.0_mm);
    const Surface both =
      drawnOut({ { 0.0, -20.0_mm }, { 25.0_mm, -20.0_mm }, { right, -20.0_mm }, { end, -20.0_mm },
                 { end, 0.0 }, { end, 40.0_mm }, { right, 40.0_mm }, { right, 0.0 },
                 { 25.0_mm, 0.0 }, { 25.0_mm, 40.0_mm }, { 0.0, 40.0_mm }, { 0.0, 0.0 } },
        { { 0, 1, 8, 11 }, { 1, 2, 7, 8 }, { 2, 3, 4, 7 }, { 4, 5, 6, 7 }, { 8, 9, 10, 11 } },
        60.0_mm);
    for (const double angle : { 0.0, 25.0 })
    {
      const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(units::fromDegrees(angle), Vector3d::UnitY()).toRotationMatrix();
      const auto constant = [&](const Surface& body)
      {
        std::vector<Vector3d> points(body.points().begin(), body.points().end());
        std::ranges::for_each(points, [&](Vector3d& point) { point = turn * point; });
        const Surface turned(points, { body.triangles().begin(), body.triangles().end() });
        EXPECT_TRUE(turned.closed());
        const Support held{ [&](const Vector3d& x) { return base.holds(turn.transpose() * x); } };
        const OrganModel model(turned, cell, 50e3, 0.45, std::span(&held, 1));
        return complianceAt(model, turned, turn * Vector3d(0.0, 30.0_mm, 25.0_mm), -turn.col(0))
          ->constant;
      };
      const double wanted = constant(alone);
      EXPECT_NEAR(constant(both), wanted, 0.05 * wanted) << gap << ", " << angle;
    }
  }
}

} // namespace
} // namespace palp
