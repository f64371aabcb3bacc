#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <Eigen/Core>
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

// rounded by less than the body is fine, a dihedral of 60 degrees or more, is sharp; 20 is not
TEST(SharpEdges, CallsSharpWhatTurnsWithinAFewCells)
{
  const auto roof = [](double angle)
  {
    return test::makeSurface(test::cubeMap(20,
      [angle](const Eigen::Vector3d& p)
      {
        return Eigen::Vector3d(50.0_mm * p.x(), 50.0_mm * p.y(),
          20.0_mm * (p.z() - 1.0) -
            (p.z() > 0.0 ? p.z() * std::tan(0.5 * angle) * std::abs(50.0_mm * p.x()) : 0.0));
      }));
  };
  EXPECT_LT(roof(80.0_deg).shape().edgeDistance({ 10.0_mm, 2.0_mm, -8.0_mm }), 20.0_mm);
  EXPECT_GT(roof(20.0_deg).shape().edgeDistance({ 10.0_mm, 2.0_mm, -2.0_mm }), 25.0_mm);
}

} // namespace
} // namespace palp
