#include "haptics/servo/period_monitor.h"

#include "haptics/units.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

TEST(PeriodMonitor, IsTheNinetyNinthPercentile)
{
  PeriodMonitor monitor(1.0_ms);
  EXPECT_EQ(monitor.period(), 1.0_ms);
  for (int i = 0; i < 1000; ++i)
  {
    monitor.record(i % 50 == 0 ? 3.0_ms : 1.0_ms); // 2 % are slow
  }
  EXPECT_NEAR(monitor.period(), 3.0_ms, 0.11_ms);
  for (int i = 0; i < 1000; ++i)
  {
    monitor.record(i % 200 == 0 ? 3.0_ms : 1.0_ms); // half a percent
  }
  EXPECT_EQ(monitor.period(), 1.0_ms);
  monitor.record(1e9);
  EXPECT_EQ(monitor.period(), 1.0_ms);
}

// of a loop that becomes slow and quick again, by sorting its last thousand ticks
TEST(PeriodMonitor, FollowsTheSlowestHundredth)
{
  std::mt19937 random(5);
  PeriodMonitor monitor(1.0_ms);
  std::vector<double> ticks;
  for (int i = 0; i < 6000; ++i)
  {
    std::gamma_distribution<double> late(1.0, (i / 1500 % 2 == 0 ? 0.3_ms : 4.0_ms));
    ticks.push_back(1.2_ms + late(random));
    monitor.record(ticks.back());
    std::vector<double> last(ticks.end() - std::min<std::ptrdiff_t>(1000, i + 1), ticks.end());
    std::ranges::sort(last, std::greater());
    const double slowest = std::min(last[last.size() / 100], 39.95_ms);
    EXPECT_NEAR(monitor.period(), slowest, 0.1_ms) << i;
  }
}

} // namespace
} // namespace palp
