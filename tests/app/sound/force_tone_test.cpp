#include "app/sound/force_tone.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace palp
{
namespace
{

constexpr double kRate = 48'000.0;

// of a second after the tone has settled, by its zeros alone [Hz]
double heardPitch(double force)
{
  ForceTone tone(kRate);
  std::vector<float> samples(static_cast<std::size_t>(kRate));
  tone.fill(force, samples);
  tone.fill(force, samples);
  int rises = 0;
  double first = -1.0;
  double last = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    if (samples[i - 1] < 0.0F && samples[i] >= 0.0F)
    {
      last = static_cast<double>(i) - samples[i] / (samples[i] - samples[i - 1]);
      first = first < 0.0 ? last : first;
      ++rises;
    }
  }
  return (rises - 1) * kRate / (last - first);
}

TEST(ForceTone, IsAnOctaveHigherAtFourTimesTheForce)
{
  for (const double force : { 0.011, 0.1, 0.37, 2.0, 9.0 })
  {
    EXPECT_NEAR(heardPitch(4.0 * force) / heardPitch(force), 2.0, 1e-3) << force;
  }
  EXPECT_NEAR(heardPitch(0.1), 220.0, 0.1);
  EXPECT_LE(heardPitch(1e6), 7041.0);
}

// two tissues that hands can just tell apart, 22 % in stiffness: 1.7 semitones
TEST(ForceTone, TellsApartWhatHandsCan)
{
  for (const double force : { 0.02, 0.3, 5.0 })
  {
    const double semitones = 12.0 * std::log2(heardPitch(1.22 * force) / heardPitch(force));
    EXPECT_NEAR(semitones, 6.0 * std::log2(1.22), 0.02) << force;
  }
}

TEST(ForceTone, NeverClicks)
{
  ForceTone tone(kRate);
  std::mt19937 random(3);
  std::vector<float> samples(480);
  float before = 0.0F;
  for (int block = 0; block < 400; ++block)
  {
    const double force =
      block % 3 == 0 ? 0.0 : std::pow(10.0, static_cast<double>(random() % 5) - 2.0);
    tone.fill(force, samples);
    for (const float sample : samples)
    {
      // the steepest slope of the highest tone
      ASSERT_LE(std::abs(sample - before), 0.25 * 2.0 * 3.1416 * 7040.0 / kRate + 1e-3) << block;
      ASSERT_LE(std::abs(sample), 0.25F);
      before = sample;
    }
  }
}

TEST(ForceTone, IsSilentWithoutAForceOrANumber)
{
  for (const double force : { 0.0, 0.009, -3.0, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    ForceTone tone(kRate);
    std::vector<float> samples(9600);
    tone.fill(2.0, samples);
    tone.fill(force, samples);
    tone.fill(force, samples);
    for (const float sample : samples)
    {
      ASSERT_LT(std::abs(sample), 1e-6F) << force;
    }
  }
}

} // namespace
} // namespace palp
