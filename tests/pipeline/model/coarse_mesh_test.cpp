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
    std::map<std::pair<int, int>, int> sides; // how much more often one way than the other
    for (const Triangle& triangle : trianglesOf(*coarse))
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto [a, b] = std::pair(triangle[i], triangle[(i + 1) % 3]);
        sides[std::minmax(a, b)] += a < b ? 1 : -1;
      }
    }
    EXPECT_EQ(std::ranges::count_if(sides, [](const auto& one) { return one.second != 0; }), 0)
      << "a hole shows what is behind: " << wanted;
    const double whole = 4.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
    EXPECT_NEAR(enclosedVolume(pointsOf(*coarse), trianglesOf(*coarse)), whole,
      4.0 * std::numbers::pi * kRadius * kRadius * bow);
  }
  EXPECT_EQ(fine->GetMTime(), before);
}

} // namespace
} // namespace palp
