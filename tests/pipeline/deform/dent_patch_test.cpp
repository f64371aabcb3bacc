#include "pipeline/deform/dent_patch.h"

#include "haptics/surface/edges.h"
#include "haptics/units.h"
#include "tests/pipeline/surfaces.h"
#include "tests/support/allocation_guard.h"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;
using test::DentedSurface;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

// a 3 mm tool between the points of a mesh of 2.2 mm
struct SmallTool : ::testing::Test
{
  DentedSurface surface = test::plane(40, 2.2_mm);
  Press press = test::pressAt({ 0.7_mm, 0.4_mm, 0.0 }, kUp, SphereTip{ 3.0_mm }, 1.5_mm, 7.0_mm);
  DentPatch patch;
};

TEST_F(SmallTool, GetsEdgesThatAreShortAgainstItsContact)
{
  surface.press(press);
  patch.build(surface.dent, DentPatch::levelFor(surface.dent));
  for (const Triangle& triangle : patch.triangles)
  {
    const Eigen::Vector3f a = patch.points[static_cast<std::size_t>(triangle[0])];
    const Eigen::Vector3f b = patch.points[static_cast<std::size_t>(triangle[1])];
    const auto near = static_cast<std::size_t>(triangle[0]);
    if (patch.distance[near] < static_cast<float>(press.contactRadius))
    {
      EXPECT_LT((b.head<2>() - a.head<2>()).norm(), 0.35 * press.contactRadius);
    }
  }
}

TEST_F(SmallTool, IsMetExactlyBetweenThePointsOfTheMesh)
{
  surface.press(press);
  patch.build(surface.dent, 3);
  const ToolBody body(press.tip, press.pose);
  int onTool = 0;
  for (std::size_t i = 0; i < patch.points.size(); ++i)
  {
    const Eigen::Vector3d point = patch.points[i].cast<double>();
    EXPECT_LE(body.inside(point), 1e-7);
    if (patch.zone[i] == Zone::Contact)
    {
      EXPECT_NEAR(body.inside(point), 0.0, 1e-7);
      ++onTool;
    }
    // normals of the patch are those of the sphere
    if (patch.distance[i] < static_cast<float>(0.8 * press.contactRadius))
    {
      const Eigen::Vector3d center = press.pose.apex + 3.0_mm * kUp;
      const Eigen::Vector3d expected = (center - point).normalized();
      EXPECT_GT(patch.normals[i].cast<double>().dot(expected), std::cos(4.0_deg));
    }
  }
  EXPECT_GT(onTool, 60);
}

TEST_F(SmallTool, LeavesNoGapToTheSurfaceAroundIt)
{
  surface.press(press);
  patch.build(surface.dent, 2);
  // edges of one triangle are the rim of the patch; they are whole edges of the mesh, at rest
  const Edges edges = edgesOf(patch.points.size(), patch.triangles);
  EXPECT_EQ(edges.crowded, 0U);
  EXPECT_GT(edges.unpaired.size(), 8U);
  for (const auto& edge : edges.unpaired)
  {
    for (const int end : edge)
    {
      const auto at = static_cast<std::size_t>(end);
      ASSERT_LT(at, surface.dent.region().points().size()); // a point of the mesh
      EXPECT_EQ(patch.sink[at], 0.0F);
      EXPECT_EQ(patch.points[at].cast<double>(),
        surface.dent.region().rest(surface.dent.region().points()[at]));
    }
  }
}

TEST_F(SmallTool, KeepsTheSurfacesOwnPoints)
{
  surface.press(press);
  patch.build(surface.dent, 2);
  const auto points = surface.dent.region().points();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto at = static_cast<std::size_t>(points[i]);
    EXPECT_EQ(patch.points[i].cast<double>(), DentedSurface::at(surface.points, at));
  }
}

TEST_F(SmallTool, IsEmptyAtRest)
{
  surface.press(Press{});
  EXPECT_EQ(DentPatch::levelFor(surface.dent), 0);
  patch.build(surface.dent, 2);
  EXPECT_TRUE(patch.points.empty());
  EXPECT_TRUE(patch.triangles.empty());
}

TEST_F(SmallTool, NeedsNoMemoryOnceItsPatchWasAsLarge)
{
  const auto pressAside = [&](double aside)
  {
    press.contact.center.x() = aside;
    press.pose.apex.x() = aside;
    surface.press(press);
    patch.build(surface.dent, 3);
  };
  press.extentRadius = 9.0_mm;
  pressAside(0.0);
  pressAside(0.3_mm);
  press.extentRadius = 7.0_mm;
  const test::AllocationGuard guard;
  for (int i = 0; i < 10; ++i)
  {
    pressAside(0.3_mm * i);
  }
  EXPECT_EQ(guard.count(), 0U);
}

} // namespace
} // namespace palp
