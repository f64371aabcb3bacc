#include "haptics/servo/timing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace std::chrono_literals;

TEST(Histogram, QuantilesAreThoseOfTheSortedDurations)
{
  Histogram histogram;
  std::mt19937 random(1);
  std::lognormal_distribution<double> spread(9.0, 2.0); // 8 us, from 10 ns to 10 ms
  std::vector<std::int64_t> all(10'000);
  for (std::int64_t& value : all)
  {
    value = static_cast<std::int64_t>(spread(random));
    histogram.record(std::chrono::nanoseconds(value));
  }
  std::sort(all.begin(), all.end());
  for (const double fraction : { 0.01, 0.5, 0.99, 0.999 })
  {
    const auto rank = static_cast<std::size_t>(fraction * 1e4) - 1;
    const auto exact = static_cast<double>(all[rank]);
    const auto found = static_cast<double>(histogram.quantile(fraction).count());
    EXPECT_GE(found, exact);
    EXPECT_LE(found, exact * 1.0625);
  }
  EXPECT_EQ(histogram.quantile(1.0).count(), all.back());
  EXPECT_EQ(histogram.longest().count(), all.back());
  EXPECT_EQ(histogram.count(), all.size());
}

TEST(Histogram, TakesWhatNoClockShouldSay)
{
  Histogram histogram;
  EXPECT_EQ(histogram.quantile(0.5), 0ns);
  histogram.record(-5ns);
  EXPECT_EQ(histogram.quantile(0.5), 0ns);
  histogram.record(std::chrono::nanoseconds::max());
  EXPECT_EQ(histogram.count(), 2U);
}

} // namespace
} // namespace palp
