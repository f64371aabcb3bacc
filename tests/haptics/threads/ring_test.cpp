#include "haptics/threads/ring.h"

#include <array>
#include <gtest/gtest.h>
#include <thread>

namespace palp
{
namespace
{

TEST(Ring, GivesEveryValueOnceAndInOrder)
{
  using Pair = std::array<long, 2>;
  constexpr long kCount = 200'000;
  Ring<Pair> ring(256);

  std::jthread writer{ [&]
    {
      for (long i = 1; i <= kCount;)
      {
        i += ring.push({ i, -i }) ? 1 : 0;
      }
    } };

  for (long expected = 1; expected <= kCount;)
  {
    ring.drain(
      [&](const Pair& seen)
      {
        ASSERT_EQ(seen[0], expected);
        ASSERT_EQ(seen[1], -expected);
        ++expected;
      });
  }
}

TEST(Ring, FullDropsTheNewestAndCounts)
{
  Ring<int> ring(4);
  for (int i = 0; i < 7; ++i)
  {
    EXPECT_EQ(ring.push(i), i < 4);
  }
  EXPECT_EQ(ring.dropped(), 3U);
  int expected = 0;
  EXPECT_EQ(ring.drain([&](int value) { EXPECT_EQ(value, expected++); }), 4U);
  EXPECT_TRUE(ring.push(9));
}

} // namespace
} // namespace palp
