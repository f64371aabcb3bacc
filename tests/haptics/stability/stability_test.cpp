#include "haptics/stability/stability.h"

#include "tests/support/sampled.h"

#include <gtest/gtest.h>

namespace palp
{
namespace
{

TEST(Stability, NoSituationMakesTheChainUnstable)
{
  for (const StabilityCase& what : stabilityCases(true))
  {
    const StabilityRow row = judge(what, true);
    EXPECT_NE(row.outcome, StabilityOutcome::Unstable) << what.name;
    EXPECT_TRUE(what.arm || row.energy >= StabilityLimits::kEnergy) << what.name;
    EXPECT_LE(row.peakForce, what.loop.forceLimit * (1.0 + 1e-9)) << what.name;
    EXPECT_TRUE((row.outcome == StabilityOutcome::Stable) == (row.limitedBy == "none") ||
      row.outcome >= StabilityOutcome::Refused)
      << what.name;
  }
}

TEST(Stability, RigidWallIsUnstableWithoutTheChain)
{
  test::Sampled samples;
  for (const StabilityCase& what : stabilityCases(true))
  {
    if (!what.material && what.name == "material" && samples.takes())
    {
      EXPECT_EQ(judge(what, false).outcome, StabilityOutcome::Unstable);
      EXPECT_EQ(judge(what, true).outcome, StabilityOutcome::Limited);
    }
  }
}

} // namespace
} // namespace palp
