#include "haptics/servo/timing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palp
{

// the leading bit gives the doubling, the four bits after it the bucket within
std::size_t Histogram::bucket(std::uint64_t nanoseconds) noexcept
{
  if (nanoseconds < kPerDoubling)
  {
    return nanoseconds;
  }
  const auto shift = static_cast<std::size_t>(std::bit_width(nanoseconds)) - 5;
  return std::min(shift * kPerDoubling + (nanoseconds >> shift), kBuckets - 1);
}

std::uint64_t Histogram::upperBound(std::size_t bucket) noexcept
{
  if (bucket < 2 * kPerDoubling)
  {
    return bucket;
  }
  const std::size_t shift = bucket / kPerDoubling - 1;
  return ((bucket % kPerDoubling + kPerDoubling + 1) << shift) - 1;
}

void Histogram::record(Duration duration) noexcept
{
  const std::int64_t nanoseconds = std::max<std::int64_t>(0, duration.count());
  counts_[bucket(static_cast<std::uint64_t>(nanoseconds))].fetch_add(1, std::memory_order_relaxed);
  if (nanoseconds > longest_.load(std::memory_order_relaxed))
  {
    longest_.store(nanoseconds, std::memory_order_relaxed);
  }
}

Histogram::Duration Histogram::quantile(double fraction) const noexcept
{
  const auto wanted =
    static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(count())));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < kBuckets; ++i)
  {
    const std::uint64_t here = counts_[i].load(std::memory_order_relaxed);
    seen += here;
    if (here > 0 && seen >= wanted)
    {
      return std::min(Duration(upperBound(i)), longest());
    }
  }
  return longest();
}

Histogram::Duration Histogram::longest() const noexcept
{
  return Duration(longest_.load(std::memory_order_relaxed));
}

std::uint64_t Histogram::count() const noexcept
{
  std::uint64_t sum = 0;
  for (const auto& bucketCount : counts_)
  {
    sum += bucketCount.load(std::memory_order_relaxed);
  }
  return sum;
}

} // namespace palp
