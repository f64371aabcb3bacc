#include "pipeline/deform/vertex_rings.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

std::vector<std::int32_t> around(const VertexRings& rings, int point)
{
  const auto chains = rings.around(point);
  return { chains.begin(), chains.end() };
}

// four triangles about point 0
const std::vector<Triangle> kFan{ { 0, 1, 2 }, { 3, 0, 2 }, { 4, 0, 3 }, { 0, 4, 1 } };

TEST(VertexRings, ClosesAroundAnInnerPoint)
{
  const VertexRings rings(5, kFan);
  auto chain = around(rings, 0);
  ASSERT_EQ(chain.size(), 5U);
  EXPECT_EQ(chain.front(), chain.back());
  chain.pop_back();
  std::rotate(chain.begin(), std::find(chain.begin(), chain.end(), 1), chain.end());
  EXPECT_EQ(chain, (std::vector<std::int32_t>{ 1, 2, 3, 4 }));
}

TEST(VertexRings, EndsAtTheRimOfAnOpenSurface)
{
  const VertexRings rings(5, kFan);
  EXPECT_EQ(around(rings, 2), (std::vector<std::int32_t>{ 3, 0, 1 }));
}

TEST(VertexRings, SeparatesSheetsThatShareAPoint)
{
  const VertexRings rings(5, std::vector<Triangle>{ { 0, 1, 2 }, { 0, 3, 4 } });
  EXPECT_EQ(around(rings, 0), (std::vector<std::int32_t>{ 1, 2, VertexRings::kEnd, 3, 4 }));
}

// a book of pages, and a fan, each with more triangles than their squares could be looked at
TEST(VertexRings, TakesAnyNumberOfTrianglesAtAPoint)
{
  constexpr int count = 200'000;
  std::vector<Triangle> fan;
  std::vector<Triangle> book;
  for (int i = 0; i < count; ++i)
  {
    fan.push_back({ 0, 1 + i, 1 + (i + 1) % count });
    book.push_back({ 0, 1, 2 + i });
  }
  const VertexRings around(count + 2, fan);
  EXPECT_EQ(around.around(0).size(), count + 1U);
  EXPECT_EQ(around.around(0).front(), around.around(0).back());
  const VertexRings pages(count + 2, book);
  EXPECT_EQ(std::ranges::count(pages.around(0), 1), count);
  EXPECT_EQ(std::ranges::count(pages.around(0), VertexRings::kEnd), count - 1);
}

TEST(VertexRings, LeavesOutTrianglesThatNameAPointTwice)
{
  const VertexRings rings(3, std::vector<Triangle>{ { 0, 0, 1 }, { 0, 1, 2 } });
  EXPECT_EQ(around(rings, 0), (std::vector<std::int32_t>{ 1, 2 }));
}

TEST(VertexRings, HasNothingAroundALonePoint)
{
  const VertexRings rings(4, std::vector<Triangle>{ { 0, 1, 2 } });
  EXPECT_TRUE(rings.around(3).empty());
}

} // namespace
} // namespace palp
