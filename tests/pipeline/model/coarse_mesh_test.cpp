#include "pipeline/model/coarse_mesh.h"

#include "data/shapes.h"
#include "haptics/surface/area_and_volume.h"
#include "pipeline/model/poly_data.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numbers>
#include <utility>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// how many sides are gone along more often one way than the other
std::ptrdiff_t openSides(vtkPolyData& mesh)
{
  std::map<std::pair<int, int>, int> sides;
  for (const Triangle& triangle : trianglesOf(mesh))
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [a, b] = std::pair(triangle[i], triangle[(i + 1) % 3]);
      sides[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::ranges::count_if(sides, [](const auto& one) { return one.second != 0; });
}

// points on the ball, no further inside between them than the bow over a cube's diagonal
TEST(CoarseMesh, OfABallHasAboutAsManyTrianglesOnIt)
{
  constexpr double kRadius = 50.0;
  const Mesh ball = makeSphere(kRadius, 7);
  const auto fine = makePolyData(ball.points, ball.triangles);
  const auto before = fine->GetMTime();
  for (const int wanted : { 5'000, 20'000, 80'000 })
  {
    const auto coarse = coarseMesh(*fine, wanted);
    EXPECT_NEAR(static_cast<double>(coarse->GetNumberOfCells()), wanted, 0.3 * wanted);
    const double side = std::sqrt(3.0 * 4.0 * std::numbers::pi * kRadius * kRadius / wanted);
    const double bow = 3.0 * side * side / (8.0 * kRadius);
    for (const Eigen::Vector3d& point : pointsOf(*coarse))
    {
      ASSERT_NEAR(point.norm(), kRadius, bow) << wanted;
    }
    EXPECT_EQ(openSides(*coarse), 0) << "a hole shows what is behind: " << wanted;
    const double whole = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
    EXPECT_NEAR(enclosedVolume(pointsOf(*coarse), trianglesOf(*coarse)), whole,
      4.0 * std::numbers::pi * kRadius * kRadius * bow);
  }
  EXPECT_EQ(fine->GetMTime(), before);
}

// a skin: walls that are nearer to each other than a cube is wide
TEST(CoarseMesh, OfAShellHasBothItsWalls)
{
  constexpr double kOuter = 50.0;
  for (const double inner : { 49.9, 49.0, 46.0 })
  {
    const Mesh wall = makeSphere(kOuter, 6);
    std::vector<Eigen::Vector3d> points = wall.points;
    std::vector<Triangle> triangles = wall.triangles;
    const auto count = static_cast<int>(points.size());
    for (const Eigen::Vector3d& point : wall.points)
    {
      points.emplace_back(inner / kOuter * point);
    }
    for (const auto& [a, b, c] : wall.triangles)
    {
      triangles.push_back({ a + count, c + count, b + count });
    }
    constexpr int kWanted = 10'000;
    const auto coarse = coarseMesh(*makePolyData(points, triangles), kWanted);
    EXPECT_NEAR(static_cast<double>(coarse->GetNumberOfCells()), kWanted, 0.3 * kWanted);
    EXPECT_EQ(openSides(*coarse), 0) << inner;
    const double side = std::sqrt(3.0 * 8.0 * std::numbers::pi * kOuter * kOuter / kWanted);
    const double bow = 3.0 * side * side / (8.0 * inner);
    const std::vector<Eigen::Vector3d> places = pointsOf(*coarse);
    double outside = 0.0;
    double astray = 0.0; // where a small part folds
    for (const Triangle& triangle : trianglesOf(*coarse))
    {
      const Eigen::Vector3d middle =
        (places[at(triangle[0])] + places[at(triangle[1])] + places[at(triangle[2])]) / 3.0;
      const Eigen::Vector3d normal = (places[at(triangle[1])] - places[at(triangle[0])])
                                       .cross(places[at(triangle[2])] - places[at(triangle[0])]);
      const double radius = normal.dot(middle) > 0.0 ? kOuter : inner; // as it faces
      outside += radius == kOuter ? 0.5 * normal.norm() : 0.0;
      astray += std::abs(middle.norm() - radius) > bow ? 0.5 * normal.norm() : 0.0;
    }
    const double whole = 4.0 * std::numbers::pi * kOuter * kOuter;
    EXPECT_NEAR(outside, whole, 0.02 * whole) << inner;
    EXPECT_LT(astray, 3e-3 * whole) << inner;
  }
}

} // namespace
} // namespace palp
