#include "data/liver.h"

#include "data/implicit.h"
#include "data/liver_mesh.h"
#include "data/press_path.h"
#include "haptics/surface/closest_point.h"
#include "haptics/surface/sampling/deviation.h"
#include "haptics/units.h"
#include "pipeline/model/poly_data.h"
#include "pipeline/surface_io/surface_io.h"
#include "tests/data/topology.h"

#include <gtest/gtest.h>
#include <limits>
#include <vtkPolyData.h>

namespace palp::test
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

// as it is shipped
Mesh shipped(const std::string& name)
{
  const LoadedSurface surface = readSurface(PALP_SHARE "/meshes/" + name);
  return { pointsOf(*surface.mesh), trianglesOf(*surface.mesh) };
}

const Mesh& liver()
{
  static const Mesh mesh = shipped("liver.vtp");
  return mesh;
}

bool inside(const Vector3d& p)
{
  return liverDistance(p) < 0.0;
}

// how far the body reaches from a point of its surface, along the inward normal [m]
double thickness(const Vector3d& surfacePoint)
{
  const Vector3d inward = -levelNormal(liverDistance, surfacePoint);
  double depth = 0.5_mm;
  while (inside(surfacePoint + depth * inward))
  {
    depth += 0.25_mm;
  }
  return depth;
}

TEST(Liver, IsOneClosedSurfaceLikeABall)
{
  EXPECT_TRUE(closedAndOriented(liver()));
  EXPECT_EQ(euler(liver()), 2);
  EXPECT_EQ(pieces(liver()), 1);
}

TEST(Liver, HasTheSizeOfAGrownPersonsLiver)
{
  const Vector3d size = extent(liver());
  EXPECT_NEAR(size.x(), 230.0_mm, 10.0_mm);
  EXPECT_NEAR(size.y(), 90.0_mm, 5.0_mm);
  EXPECT_NEAR(size.z(), 160.0_mm, 8.0_mm);
  // 1.0 to 1.8 litres
  EXPECT_GT(volume(liver()), 1.0e-3);
  EXPECT_LT(volume(liver()), 1.8e-3);
}

TEST(Liver, HasAboutTwentyThousandEvenlySpacedPoints)
{
  EXPECT_NEAR(static_cast<double>(liver().points.size()), 20000.0, 1000.0);
  EXPECT_GT(smallestAngle(liver()), 15.0_deg);
  for (const auto& [a, b] : edgesOf(liver()))
  {
    const double length = (liver().points[a] - liver().points[b]).norm();
    ASSERT_GT(length, 0.5_mm);
    ASSERT_LT(length, 4.0_mm);
  }
}

TEST(Liver, HasItsPointsOnTheImplicitSurfaceAndNoFoldedTriangle)
{
  for (const Vector3d& p : liver().points)
  {
    ASSERT_LT(std::abs(liverDistance(p)), 1e-7); // single precision
  }
  for (const auto& [a, b, c] : liver().triangles)
  {
    const auto& points = liver().points;
    const Vector3d normal = (points[b] - points[a]).cross(points[c] - points[a]).normalized();
    const Vector3d center = (points[a] + points[b] + points[c]) / 3.0;
    ASSERT_GT(normal.dot(levelNormal(liverDistance, center)), 0.8);
  }
}

TEST(Liver, IsTheSameEveryTime)
{
  const Mesh once = makeLiver(4.0_mm);
  const Mesh again = makeLiver(4.0_mm);
  EXPECT_EQ(once.points, again.points);
  EXPECT_EQ(once.triangles, again.triangles);
}

TEST(Liver, IsThickOnTheRight)
{
  const Vector3d front = ontoSurface(liverDistance, { -45.0_mm, -45.0_mm, 5.0_mm });
  EXPECT_GT(thickness(front), 60.0_mm);
}

TEST(Liver, TapersToAThinEdgeOnTheLeft)
{
  for (const double x : { 30.0_mm, 50.0_mm, 70.0_mm, 90.0_mm })
  {
    Vector3d lowest(0.0, 0.0, 1.0);
    for (const Vector3d& p : liver().points)
    {
      if (std::abs(p.x() - x) < 2.0_mm && p.z() < lowest.z())
      {
        lowest = p;
      }
    }
    // from front to back, 4 mm above the edge
    int samples = 0;
    for (double y = -60.0_mm; y < 60.0_mm; y += 0.25_mm)
    {
      samples += inside({ x, y, lowest.z() + 4.0_mm });
    }
    EXPECT_GT(samples, 0);
    EXPECT_LT(samples * 0.25_mm, 10.0_mm) << "at x = " << x;
  }
}

TEST(Liver, IsConvexInFrontOfTheRightLobe)
{
  std::vector<Vector3d> front;
  for (const Vector3d& p : liver().points)
  {
    if (p.x() > -90.0_mm && p.x() < -10.0_mm && std::abs(p.z()) < 50.0_mm && p.y() < -15.0_mm &&
      levelNormal(liverDistance, p).y() < -0.5)
    {
      front.push_back(p);
    }
  }
  ASSERT_GT(front.size(), 500u);
  for (std::size_t i = 0; i + 97 < front.size(); i += 7)
  {
    const Vector3d& from = front[i];
    const Vector3d& to = front[(i * 31 + 97) % front.size()];
    if ((to - from).norm() > 10.0_mm)
    {
      ASSERT_TRUE(inside((from + to) / 2.0)) << from.transpose() << " to " << to.transpose();
    }
  }
}

// height of the lowest part of the body above a place in the horizontal plane [m]
double underside(double x, double y)
{
  double z = -100.0_mm;
  while (!inside({ x, y, z }) && z < 100.0_mm)
  {
    z += 0.25_mm;
  }
  return z;
}

TEST(Liver, HasAFossaForTheGallbladder)
{
  const double flanks = (underside(-50.0_mm, -25.0_mm) + underside(0.0, -25.0_mm)) / 2.0;
  EXPECT_GT(underside(-25.0_mm, -25.0_mm), flanks + 5.0_mm);
}

TEST(Liver, HasANotchBetweenTheLobes)
{
  const double flanks = (underside(-2.0_mm, -35.0_mm) + underside(26.0_mm, -35.0_mm)) / 2.0;
  EXPECT_GT(underside(12.0_mm, -35.0_mm), flanks + 2.0_mm);
}

TEST(Liver, IsHollowedBelow)
{
  // higher than the chord: under the right lobe by the kidney, under the left by the stomach
  const double right = (underside(-60.0_mm, -24.0_mm) + underside(-60.0_mm, 24.0_mm)) / 2.0;
  EXPECT_GT(underside(-60.0_mm, 0.0), right + 2.0_mm);
  const double left = (underside(60.0_mm, -32.0_mm) + underside(60.0_mm, 0.0)) / 2.0;
  EXPECT_GT(underside(60.0_mm, -16.0_mm), left + 2.0_mm);
}

TEST(Liver, KeepsItsShapeInTheHapticLevel)
{
  const Mesh haptic = shipped("liver_haptic.vtp");
  EXPECT_LE(haptic.points.size(), 2500u);
  EXPECT_TRUE(closedAndOriented(haptic));
  EXPECT_EQ(euler(haptic), 2);
  const Deviation apart =
    deviation(Surface(liver().points, liver().triangles), Surface(haptic.points, haptic.triangles));
  EXPECT_LT(apart.largest, 0.6_mm);
  EXPECT_LT(apart.rootMeanSquare, 0.1_mm);
}

// depth of the 10 mm sphere at a knot, negative above the surface [m]
double depthAt(const Surface& surface, const PathKnot& knot)
{
  const Vector3d center = knot.apex - 10.0_mm * *knot.axis;
  return 10.0_mm -
    findClosestPoint(surface, center, std::numeric_limits<double>::infinity()).distance;
}

TEST(PressPath, PressesEightMillimetersDeepSlidesAndLifts)
{
  const Surface surface(liver().points, liver().triangles);
  const ScriptedPath path = readPath(PALP_SOURCE_DIR "/data/paths/liver_press.csv");
  EXPECT_DOUBLE_EQ(path.duration(), 4.0);
  EXPECT_TRUE(path.hasAxes());
  EXPECT_NEAR(depthAt(surface, path.knots().front()), -5.0_mm, 0.05_mm);
  EXPECT_NEAR(depthAt(surface, path.knots().back()), -5.0_mm, 0.05_mm);
  for (const PathKnot& knot : path.knots())
  {
    const double depth = depthAt(surface, knot);
    EXPECT_LT(depth, 8.05_mm);
    if (knot.time > 1.49 && knot.time < 3.21)
    {
      EXPECT_NEAR(depth, 8.0_mm, 0.05_mm) << "at " << knot.time << " s";
    }
  }
  const Vector3d before = path.poseAt(1.9, Vector3d::UnitZ()).apex;
  const Vector3d after = path.poseAt(3.1, Vector3d::UnitZ()).apex;
  EXPECT_NEAR((after - before).norm(), 12.0_mm, 1.0_mm);
}

TEST(PressPath, IsShippedAsTheGeneratorMakesIt)
{
  const std::vector<PathKnot> made = liverPressPath();
  const ScriptedPath shipped = readPath(PALP_SOURCE_DIR "/data/paths/liver_press.csv");
  ASSERT_EQ(shipped.knots().size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i)
  {
    ASSERT_NEAR(shipped.knots()[i].time, made[i].time, 1e-9);
    ASSERT_LT((shipped.knots()[i].apex - made[i].apex).norm(), 0.001_mm);
    ASSERT_LT((*shipped.knots()[i].axis - *made[i].axis).norm(), 1e-5);
  }
}

} // namespace
} // namespace palp::test
