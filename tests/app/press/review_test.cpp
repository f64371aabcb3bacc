#include "app/press/review.h"

#include "app/press/presses.h"
#include "haptics/devices/simulated/scripted_device.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

// touching in the middle third
Recording recordingAt(const std::vector<double>& times)
{
  Recording recording;
  for (std::size_t i = 0; i < times.size(); ++i)
  {
    Sample& sample = recording.samples.emplace_back();
    sample.time = times[i];
    sample.contact.depth = i >= times.size() / 3 && i < 2 * times.size() / 3 ? 1.0_mm : 0.0;
  }
  return recording;
}

// among samples with gaps, as a rest or thinning leaves them
TEST(Review, ShowsTheSampleNearestToATime)
{
  std::mt19937 random(7); // the same each time
  std::exponential_distribution<double> gap(5.0);
  std::vector<double> times{ 12.0 };
  while (times.size() < 300)
  {
    times.push_back(times.back() + 1e-3 + gap(random));
  }
  const Recording recording = recordingAt(times);
  std::uniform_real_distribution<double> any(times.front() - 5.0, times.back() + 5.0);
  for (int i = 0; i < 5000; ++i)
  {
    const double time = any(random);
    double least = HUGE_VAL;
    for (const double each : times)
    {
      least = std::min(least, std::abs(each - time));
    }
    ASSERT_EQ(std::abs(nearestSample(recording.samples, time)->time - time), least) << time;
  }
  EXPECT_EQ(nearestSample({}, 0.0), nullptr);
}

TEST(Review, IsOfTheContactWithASampleBesideIt)
{
  const Recording recording = recordingAt({ 0.0, 30.0, 31.0, 31.5, 32.0, 900.0 });
  Review review(recording);
  EXPECT_DOUBLE_EQ(review.head().length(), 2.0); // from 30 to 32
  EXPECT_EQ(review.at(recording), &recording.samples[1]);
  (void)review.head().advance(100.0);
  EXPECT_EQ(review.at(recording), &recording.samples[4]);
  (void)review.head().obey({ .place = 1.4, .seeks = 1 });
  EXPECT_EQ(review.at(recording), &recording.samples[3]);
  EXPECT_EQ(review.at(Recording{}), nullptr);
}

TEST(Review, OfASingleSampleStandsStill)
{
  Recording recording;
  recording.samples.emplace_back().contact.depth = 1.0_mm;
  Review review(recording);
  EXPECT_EQ(review.head().length(), 0.0);
  (void)review.head().advance(1.0);
  EXPECT_EQ(review.at(recording), &recording.samples[0]);
}

// a device that is sent from contact to contact, and begins anew
TEST(Review, ASeekAndALoopBeginAnotherPress)
{
  Recording recording;
  recording.scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 20)));
  recording.scene.law = ForceLaw(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.33 });
  ScriptedDevice device(ScriptedPath({ { .time = 0.0, .apex = { 0.0, 0.0, -5.0_mm } },
    { .time = 1.0, .apex = { 50.0_mm, 0.0, -5.0_mm } } }));
  const auto play = [&](int ticks)
  {
    for (int tick = 0; tick < ticks; ++tick)
    {
      Sample& sample = recording.samples.emplace_back(
        step(recording.scene, *device.exchange(Eigen::Vector3d::Zero(), 1.0_ms)));
      sample.time = 1e-3 * static_cast<double>(recording.samples.size());
    }
  };
  play(300);
  EXPECT_EQ(findPresses(recording).size(), 1U);
  device.play({ .loops = true, .place = 0.8, .seeks = 1 });
  play(100);
  EXPECT_EQ(findPresses(recording).size(), 2U);
  play(300); // beyond the end
  EXPECT_EQ(findPresses(recording).size(), 3U);
  device.play({ .loops = true, .place = device.reached() + 0.010, .seeks = 2 });
  play(100);
  EXPECT_EQ(findPresses(recording).size(), 3U) << "a step goes on with the press";
}

} // namespace
} // namespace palp
