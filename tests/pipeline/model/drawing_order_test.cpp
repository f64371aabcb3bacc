#include "pipeline/model/drawing_order.h"

#include "data/shapes.h"

#include <algorithm>
#include <deque>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

// corners that a graphics card shades, whose memory holds so many of the last ones
std::size_t shaded(const std::vector<Triangle>& triangles, std::size_t memory)
{
  std::deque<int> last;
  std::size_t count = 0;
  for (const Triangle& triangle : triangles)
  {
    for (const int corner : triangle)
    {
      if (std::ranges::find(last, corner) == last.end())
      {
        ++count;
        last.push_back(corner);
        last.size() > memory ? last.pop_front() : void();
      }
    }
  }
  return count;
}

// any order, any numbers of the points
std::vector<Triangle> shuffled(std::vector<Triangle> triangles, std::size_t points)
{
  std::mt19937 random(3);
  std::vector<int> number(points);
  std::ranges::generate(number, [i = 0]() mutable { return i++; });
  std::ranges::shuffle(number, random);
  for (Triangle& triangle : triangles)
  {
    std::ranges::transform(triangle, triangle.begin(), [&](int i) { return number[at(i)]; });
  }
  std::ranges::shuffle(triangles, random);
  return triangles;
}

TEST(DrawingOrder, ShadesFewCornersTwice)
{
  const Mesh ball = makeSphere(0.05, 5);
  const Mesh grid = makeGrid(90, 0.1);
  const Mesh box = makeBox({ 0.1, 0.1, 0.05 }, 0.0025);
  for (const Mesh& mesh : { ball, grid, box })
  {
    const auto triangles = shuffled(mesh.triangles, mesh.points.size());
    const auto ordered = inDrawingOrder(triangles, mesh.points.size());
    EXPECT_GT(shaded(triangles, 64), triangles.size() * 25 / 10);
    // a point has two triangles, so that no order does better than a half
    EXPECT_LT(shaded(ordered, 64), triangles.size() * 68 / 100);
    EXPECT_LT(shaded(ordered, 32), triangles.size() * 80 / 100);
  }
}

TEST(DrawingOrder, KeepsEveryTriangleAsItIs)
{
  // a sliver, one twice, two pieces, points without any
  const std::vector<Triangle> odd{ { 7, 1, 2 }, { 2, 1, 4 }, { 2, 1, 4 }, { 5, 5, 8 },
    { 9, 11, 8 } };
  const auto grid = shuffled(makeGrid(20, 0.1).triangles, 441);
  for (const auto& triangles : { odd, grid, std::vector<Triangle>{} })
  {
    auto ordered = inDrawingOrder(triangles, 441);
    auto expected = triangles;
    std::ranges::sort(ordered);
    std::ranges::sort(expected);
    EXPECT_EQ(ordered, expected);
  }
}

} // namespace
} // namespace palp
