#include "app/session/sample_readers.h"

#include <future>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

void add(Recording& recording, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    Sample& sample = recording.samples.emplace_back();
    sample.time = static_cast<double>(recording.samples.size());
    sample.contact.depth = 1e-3;
  }
}

// what is added meanwhile is of no recording that was asked for before, and moves nothing
TEST(SampleReaders, CopyWhatWasThereWhileMoreComes)
{
  constexpr std::size_t kCount = kKeptWhole / 10 + 1;
  Recording recording;
  add(recording, kCount);
  bound(recording); // from here on in memory that is taken once
  const SampleReaders readers;
  auto copy = std::async(std::launch::async,
    [take = readers.of(recording, true)]() mutable { return std::exchange(take, nullptr)(); });
  add(recording, kCount);
  readers.wait();
  EXPECT_FALSE(readers.any());
  recording.samples.clear();
  const std::vector<Sample> copied = copy.get();
  ASSERT_EQ(copied.size(), kCount);
  for (std::size_t i = 0; i < kCount; ++i)
  {
    ASSERT_EQ(copied[i].time, static_cast<double>(i + 1));
  }
}

TEST(SampleReaders, HoldNothingWhereNobodyCopies)
{
  constexpr std::size_t kCount = kKeptWhole / 10 + 1;
  Recording recording;
  add(recording, kCount);
  const SampleReaders readers;
  {
    const auto take = readers.of(recording, false);
    EXPECT_TRUE(readers.any());
  }
  EXPECT_FALSE(readers.any());
}

// memory of few grows, and moves them
TEST(SampleReaders, OfFewCopyAtOnce)
{
  Recording recording;
  add(recording, 10);
  const SampleReaders readers;
  const auto take = readers.of(recording, true);
  EXPECT_FALSE(readers.any());
  recording.samples.clear();
  recording.samples.shrink_to_fit();
  EXPECT_EQ(take().size(), 10U);
}

} // namespace
} // namespace palp
