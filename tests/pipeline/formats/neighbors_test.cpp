#include "pipeline/formats/regions/neighbors.h"

#include "data/shapes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>

namespace palp
{
namespace
{

enum class Order
{
  Given,
  Grouped,
  Shuffled
};

Mesh sphereIn(Order order)
{
  Mesh sphere = makeSphere(0.06, 5);
  if (order == Order::Grouped)
  {
    groupByTriangles(sphere.points, sphere.triangles);
  }
  else if (order == Order::Shuffled) // so that each block has neighbors in all
  {
    std::vector<int> number(sphere.points.size());
    std::iota(number.begin(), number.end(), 0);
    std::ranges::shuffle(number, std::mt19937(7));
    const std::vector<Eigen::Vector3d> points = sphere.points;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      sphere.points[at(number[i])] = points[i];
    }
    for (Triangle& triangle : sphere.triangles)
    {
      std::ranges::for_each(triangle, [&](int& corner) { corner = number[at(corner)]; });
    }
  }
  return sphere;
}

class EachOrder : public testing::TestWithParam<Order>
{
};

// Each step of a point, when it is done: that before was done at all neighbors, and that after at
// none, so that they may write where their neighbors read.
TEST_P(EachOrder, WavesDoEachStepOnceAndAfterThatOfTheNeighborsBefore)
{
  const Mesh sphere = sphereIn(GetParam());
  const std::size_t count = sphere.points.size();
  const Neighbors neighbors(count, edgesOf(count, sphere.triangles));
  for (const std::size_t steps : { 1U, 2U, 39U, 40U, 41U, 101U })
  {
    std::vector<std::size_t> done(count, 0); // steps of each point
    std::size_t wrong = 0;
    neighbors.inWaves(steps,
      [&](std::size_t step, std::size_t block)
      {
        neighbors.each(block,
          [&](std::size_t i, auto around)
          {
            wrong += done[i] != step;
            wrong += around.size() != neighbors.of(i).size();
            for (const int neighbor : around)
            {
              wrong += done[at(neighbor)] < step || done[at(neighbor)] > step + 1;
            }
          });
        neighbors.each(block, [&](std::size_t i, auto) { ++done[i]; });
      });
    EXPECT_EQ(wrong, 0U) << steps;
    EXPECT_EQ(std::ranges::count(done, steps), std::ssize(done)) << steps;
  }
}

TEST_P(EachOrder, NeighborsAreThoseOfTheTriangles)
{
  const Mesh sphere = sphereIn(GetParam());
  std::vector<std::set<int>> expected(sphere.points.size());
  for (const auto& [a, b, c] : sphere.triangles)
  {
    expected[at(a)].insert({ b, c });
    expected[at(b)].insert({ a, c });
    expected[at(c)].insert({ a, b });
  }
  const Neighbors neighbors(expected.size(), edgesOf(expected.size(), sphere.triangles));
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const std::span<const int> around = neighbors.of(i);
    EXPECT_EQ(std::set<int>(around.begin(), around.end()), expected[i]);
    EXPECT_EQ(around.size(), expected[i].size());
  }
}

INSTANTIATE_TEST_SUITE_P(
  Neighbors, EachOrder, testing::Values(Order::Given, Order::Grouped, Order::Shuffled));

// the same triangles, each at the same places
TEST(Neighbors, GroupingOnlyNumbersAnew)
{
  const Mesh given = sphereIn(Order::Given);
  const Mesh grouped = sphereIn(Order::Grouped);
  ASSERT_EQ(grouped.points.size(), given.points.size());
  ASSERT_EQ(grouped.triangles.size(), given.triangles.size());
  for (std::size_t i = 0; i < given.triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_EQ(
        grouped.points[at(grouped.triangles[i][k])], given.points[at(given.triangles[i][k])]);
    }
  }
}

} // namespace
} // namespace palp
