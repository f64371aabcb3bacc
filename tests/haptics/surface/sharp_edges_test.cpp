#include "haptics/surface/edges.h"
#include "haptics/surface/facet_part.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

// on closed bodies, however they are cut, as exactly as it is asked for: within a contact, too
TEST(SharpEdges, MeasuresTheDistanceToASharpEdge)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (const int n : { 1, 3, 10, 40 })
  {
    const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, n));
    ASSERT_TRUE(block.closed());
    for (const double distance : { 0.0_mm, 0.3_mm, 1.0_mm, 8.0_mm, 12.0_mm, 20.0_mm, 35.0_mm })
    {
      EXPECT_NEAR(block.shape().edgeDistance({ 50.0_mm - distance, 2.0_mm, 0.0 }), distance, 1.0_um)
        << n;
    }
    for (int i = 0; i < 100; ++i)
    {
      const Eigen::Vector3d at(50.0_mm * part(random), 50.0_mm * part(random), 0.0);
      const double toSide = 50.0_mm - at.cwiseAbs().maxCoeff();
      EXPECT_NEAR(block.shape().edgeDistance(at), toSide, 1.0_um) << n;
    }
  }
}

// facets of a cylinder turn by 15 degrees where they meet, also beside its rim, by however few
// triangles
TEST(SharpEdges, CountsNoFacetOfACylinderAsAnEdgeBesideItsRim)
{
  const int facets = 24;
  const double radius = 40.0_mm;
  const double height = 50.0_mm;
  test::Mesh mesh;
  for (int i = 0; i < 2 * facets; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * (i % facets) / facets;
    mesh.first.emplace_back(
      radius * std::cos(angle), radius * std::sin(angle), i < facets ? 0.0 : -height);
  }
  for (int i = 0; i < facets; ++i)
  {
    const int next = (i + 1) % facets;
    mesh.second.push_back({ i, facets + next, next });
    mesh.second.push_back({ i, facets + i, facets + next });
    if (i > 0 && next > 0)
    {
      mesh.second.push_back({ 0, i, next });
      mesh.second.push_back({ facets, facets + next, facets + i });
    }
  }
  const Surface cylinder = test::makeSurface(mesh);
  ASSERT_TRUE(cylinder.closed());
  for (const double below : { 1.0_mm, 3.0_mm, 6.0_mm, 10.0_mm, 15.0_mm, 25.0_mm })
  {
    for (double angle = 0.0; angle < 2.0 * std::numbers::pi; angle += 1.7_deg)
    {
      const Eigen::Vector3d place(radius * std::cos(angle), radius * std::sin(angle), -below);
      EXPECT_NEAR(cylinder.shape().edgeDistance(place), below, 0.4_mm) << angle;
    }
  }
}

// two slopes that meet in a ridge along y at the origin, rounded over so far to each side
Surface roof(double angle, int n, double rounding = 0.0)
{
  const auto drop = [=](double x)
  {
    const double aside = std::abs(x);
    const double past = std::max(0.0, aside - rounding);
    const double within = std::min(aside, rounding);
    return std::tan(0.5 * angle) *
      (past + (rounding > 0.0 ? 0.5 * within * within / rounding : 0.0));
  };
  return test::makeSurface(test::cubeMap(n,
    [&](const Eigen::Vector3d& p)
    {
      return Eigen::Vector3d(50.0_mm * p.x(), 50.0_mm * p.y(),
        20.0_mm * (p.z() - 1.0) - (p.z() > 0.0 ? p.z() * drop(50.0_mm * p.x()) : 0.0));
    }));
}

// what turns by 17 degrees or more between flat faces is an edge, by however many triangles, up to
// its ends
TEST(SharpEdges, AreThoseBetweenFlatFacesHoweverObtuse)
{
  for (const int n : { 8, 20, 50 })
  {
    for (const double angle : { 20.0_deg, 30.0_deg, 40.0_deg, 44.0_deg, 60.0_deg, 80.0_deg })
    {
      const Surface surface = roof(angle, n);
      const double slope = 0.5 * angle;
      for (const double along : { 3.0_mm, 12.0_mm })
      {
        for (const double y : { -22.0_mm, 1.0_mm, 17.0_mm })
        {
          const Eigen::Vector3d place(along * std::cos(slope), y, -along * std::sin(slope));
          EXPECT_NEAR(surface.shape().edgeDistance(place), along, 1.0_um) << angle << ' ' << n;
        }
      }
    }
    EXPECT_GT(roof(10.0_deg, n).shape().edgeDistance({ 10.0_mm, 2.0_mm, -1.0_mm }), 25.0_mm) << n;
  }
}

// in the two triangles or more to each side of it of a mesh that resolves it
TEST(SharpEdges, AreNoneWhereABodyIsRounded)
{
  for (const double angle : { 20.0_deg, 30.0_deg, 40.0_deg })
  {
    EXPECT_GT(roof(angle, 50, 8.0_mm).shape().edgeDistance({ 10.0_mm, 2.0_mm, -2.0_mm }), 25.0_mm)
      << angle;
  }
}

// facets of what is round, also where few stand for it
TEST(SharpEdges, HaveNoCreaseOnABodyOfFewFacets)
{
  const auto creases = [](const test::Mesh& mesh)
  {
    const Edges edges = edgesOf(mesh.first.size(), mesh.second);
    const Creases found = creasesOf({ mesh.first, mesh.second, edges.across });
    return std::ranges::count_if(
      found.sides, [](const std::array<bool, 3>& of) { return std::ranges::count(of, true) > 0; });
  };
  for (const int n : { 4, 6, 8, 20 })
  {
    for (const double flatness : { 1.0, 0.7, 0.5 })
    {
      test::Mesh ball = test::ball(40.0_mm, n);
      for (Eigen::Vector3d& point : ball.first)
      {
        point.z() *= flatness;
      }
      EXPECT_EQ(creases(ball), 0) << n << ' ' << flatness;
    }
  }
  for (const int around : { 8, 10, 20 })
  {
    EXPECT_EQ(creases(test::torus(40.0_mm, 15.0_mm, 2 * around, around)), 0) << around;
  }
}

} // namespace
} // namespace palp
