#include "haptics/servo/guards/oscillation_guard.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

// swings of a frequency [Hz], of 5 cm/s at first, growing or dying by a rate [1/s]
void swing(OscillationGuard& guard, double frequency, double rate, double duration)
{
  for (double time = 0.0; time < duration; time += 1.0_ms)
  {
    const double speed =
      0.05 * std::exp(rate * time) * std::sin(2.0 * std::numbers::pi * frequency * time);
    guard.record(speed, true, 1.0_ms);
  }
}

TEST(OscillationGuard, LeavesAPressAndADyingSwingAlone)
{
  OscillationGuard guard(0.0);
  swing(guard, 15.0, -5.0, 2.0);
  for (int tick = 0; tick < 2000; ++tick)
  {
    guard.record(tick < 1000 ? -0.02 : 0.02, true, 1.0_ms);
  }
  EXPECT_EQ(guard.stiffnessShare(), 1.0);
  EXPECT_EQ(guard.damping(500.0), 0.0);
}

TEST(OscillationGuard, DampsAHandThatPalpatesButDoesNotSoftenWhatItFeels)
{
  OscillationGuard guard(0.0);
  swing(guard, 2.0, 0.0, 5.0);
  EXPECT_EQ(guard.stiffnessShare(), 1.0);
  EXPECT_GT(guard.damping(200.0), 0.0);
  EXPECT_LE(guard.damping(200.0), 2.0); // [N s/m]
}

TEST(OscillationGuard, SoftensWhatIsQuickerThanAHand)
{
  OscillationGuard kept(0.0);
  swing(kept, 20.0, 0.0, 1.0);
  EXPECT_LT(kept.stiffnessShare(), 0.5);
  OscillationGuard grown(0.0);
  swing(grown, 20.0, 10.0, 0.15);
  EXPECT_LT(grown.stiffnessShare(), 0.8);
}

TEST(OscillationGuard, ForgetsWhenTheToolHasLifted)
{
  OscillationGuard guard(0.0);
  swing(guard, 20.0, 0.0, 1.0);
  for (int tick = 0; tick < 1900; ++tick)
  {
    guard.record(0.0, false, 1.0_ms);
  }
  EXPECT_LT(guard.stiffnessShare(), 1.0);
  for (int tick = 0; tick < 200; ++tick)
  {
    guard.record(0.0, false, 1.0_ms);
  }
  EXPECT_EQ(guard.stiffnessShare(), 1.0);
}

TEST(OscillationGuard, TakesStepsOfAnEncoderForNoSwing)
{
  OscillationGuard guard(48.0_um);
  for (int tick = 0; tick < 2000; ++tick)
  {
    guard.record(tick % 2 == 0 ? 0.048 : -0.048, true, 1.0_ms); // one step, back and forth
  }
  EXPECT_EQ(guard.damping(500.0), 0.0);
}

} // namespace
} // namespace palp
