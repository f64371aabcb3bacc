#include "haptics/threads/latest.h"

#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <thread>

namespace palp
{
namespace
{

TEST(Latest, ReaderNeverSeesATornOrAnOlderValue)
{
  using Pair = std::array<long, 2>;
  constexpr long kCount = 200'000;
  Latest<Pair> latest{ Pair{ 0, 0 } };

  std::jthread writer{ [&]
    {
      for (long i = 1; i <= kCount; ++i)
      {
        latest.publish({ i, i });
      }
    } };

  for (long previous = 0; previous < kCount;)
  {
    const Pair& seen = latest.read();
    ASSERT_EQ(seen[0], seen[1]);
    ASSERT_GE(seen[0], previous);
    previous = seen[0];
  }
}

// the property that keeps deallocation out of the servo thread
TEST(Latest, OnlyTheWriterReleasesAValue)
{
  auto surface = std::make_shared<const int>(1);
  const std::weak_ptr<const int> watch = surface;
  Latest<std::shared_ptr<const int>> latest;

  latest.publish(std::move(surface));
  EXPECT_EQ(*latest.read(), 1);
  latest.publish(nullptr);
  EXPECT_EQ(latest.read(), nullptr);
  EXPECT_FALSE(watch.expired()); // the reader has moved on, the slot has not

  latest.publish(nullptr);
  latest.publish(nullptr);
  EXPECT_TRUE(watch.expired()); // the writer has come round to it
}

} // namespace
} // namespace palp
