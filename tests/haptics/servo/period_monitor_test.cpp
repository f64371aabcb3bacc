#include "haptics/servo/period_monitor.h"

#include "haptics/units.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace palp
