#include "app/press/recording.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <initializer_list>
#include <iterator>
#include <random>
#include <sstream>
#include <vector>

namespace palp
{
namespace
{

Recording recordingOf(const std::vector<double>& depths)
{
  Recording recording;
  for (const double depth : depths)
  {
    Sample& sample = recording.samples.emplace_back();
    sample.contact.depth = depth;
  }
  return recording;
}

std::vector<double> depthsOf(std::span<const Sample> samples)
{
  std::vector<double> depths;
  for (const Sample& sample : samples)
  {
    depths.push_back(sample.contact.depth);
  }
  return depths;
}

TEST(Recording, ThePressIsTheLastContactNotTheDeepest)
{
  using Depths = std::vector<double>;
  EXPECT_EQ(depthsOf(recordingOf({ 0, 3, 9, 4, 0, 0, 1, 2, 1 }).lastPress()), (Depths{ 1, 2, 1 }));
  EXPECT_EQ(depthsOf(recordingOf({ 0, 3, 9, 4, 0, 1, 0, 0 }).lastPress()), (Depths{ 1 }));
  EXPECT_EQ(depthsOf(recordingOf({ 5, 6 }).lastPress()), (Depths{ 5, 6 }));
  EXPECT_TRUE(recordingOf({ 0, 0 }).lastPress().empty());
  EXPECT_TRUE(recordingOf({}).lastPress().empty());
}

TEST(Recording, TheDeepestIsTheFirstOfItsDepth)
{
  const Recording recording = recordingOf({ 0, 3, 9, 9, 1 });
  EXPECT_EQ(recording.deepest(), &recording.samples[2]);
  EXPECT_EQ(recordingOf({ 0 }).deepest(), nullptr);
}

// a day of holding and pressing, in a bound of six seconds
TEST(Recording, ThatGrowsIsBoundedAndKeepsItsExtremesAndEachContact)
{
  constexpr std::size_t kKept = 6000;
  Recording recording;
  std::size_t most = 0;
  std::size_t full = 0; // samples, before any were left out
  const Sample* first = nullptr;
  double deepest = 0.0;
  double strongest = 0.0;
  std::mt19937 random(1); // the same samples each time
  std::uniform_real_distribution<double> noise(0.0, 1e-4);
  for (int i = 0; i < 1'000'000; ++i)
  {
    Sample& sample = recording.samples.emplace_back();
    const bool lifted = i / 20'000 % 2 == 1;
    sample.time = 1e-3 * i;
    sample.contact.depth = lifted ? 0.0 : 5e-3 + noise(random);
    sample.response.force = lifted ? 0.0 : 3.0 + noise(random);
    deepest = std::max(deepest, sample.contact.depth);
    strongest = std::max(strongest, sample.response.force);
    bound(recording, kKept);
    most = std::max(most, recording.samples.size());
    full = recording.thinned == 0 ? most : full;
    first = recording.thinned == 0 ? recording.samples.data() : first;
  }
  EXPECT_LE(most, kKept * 14 / 10);
  EXPECT_EQ(most, full) << "what is left out of a full recording makes room for what comes";
  EXPECT_EQ(recording.samples.data(), first) << "in the same memory";
  EXPECT_EQ(recording.deepest()->contact.depth, deepest);
  const auto& samples = recording.samples;
  const auto force = [](const Sample& sample) { return sample.response.force; };
  EXPECT_EQ(std::ranges::max(samples, {}, force).response.force, strongest);
  for (std::size_t i = samples.size() - kKept; i < samples.size(); ++i)
  {
    EXPECT_NEAR(samples[i].time - samples[i - 1].time, 1e-3, 1e-9) << i;
  }
  int contacts = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
  {
    ASSERT_GT(samples[i].time, samples[i - 1].time);
    contacts += samples[i].contact.touching() && !samples[i - 1].contact.touching();
  }
  EXPECT_EQ(contacts, 24);
  std::ostringstream text;
  writeSamples(text, recording, nullptr);
  EXPECT_NE(text.str().find("# of a long recording: before "), std::string::npos);
}

TEST(Recording, OfTenMinutesIsWhole)
{
  Recording recording;
  recording.samples.resize(kKeptWhole);
  bound(recording);
  EXPECT_EQ(recording.samples.size(), kKeptWhole);
  EXPECT_EQ(recording.thinned, 0U);
}

// a day again, by small parts, and asked for now and then
TEST(Recording, BoundedInPartsIsAsIfAtOnce)
{
  constexpr std::size_t kKept = 2000;
  Recording whole;
  Recording parts;
  int compared = 0;
  for (int i = 0; i < 100'000; ++i)
  {
    Sample sample;
    sample.time = 1e-3 * i;
    sample.contact.depth = 1e-3 * (1.0 + std::sin(0.01 * i));
    sample.response.force = std::cos(0.017 * i);
    whole.samples.push_back(sample);
    parts.samples.push_back(sample);
    bound(whole, kKept);
    boundSome(parts, 150, kKept);
    ASSERT_EQ(parts.samples.back().time, sample.time);
    if (parts.gap.thinsTo == 0 || i % 9973 == 0)
    {
      closeGap(parts);
      ASSERT_EQ(parts.samples.size(), whole.samples.size()) << i;
      ASSERT_EQ(parts.thinned, whole.thinned);
      ASSERT_TRUE(
        std::ranges::equal(parts.samples, whole.samples, {}, &Sample::time, &Sample::time));
      ++compared;
    }
  }
  EXPECT_LT(compared, 100'000) << "and was not always at once";
  EXPECT_GT(whole.interval, 0.4);
}

// as of two programs, whose clocks both begin at 0
TEST(Recording, AppendsSamplesAtTheirTimesOrAfterTheLast)
{
  const auto samplesAt = [](std::initializer_list<double> times)
  {
    std::vector<Sample> samples;
    for (const double time : times)
    {
      samples.emplace_back().time = time;
    }
    return samples;
  };
  Recording all;
  append(all, samplesAt({ 3.0, 4.0 }));
  append(all, samplesAt({ 9.0, 9.5 }));
  append(all, samplesAt({ 2.0, 2.25 }));
  append(all, {});
  std::vector<double> times;
  std::ranges::transform(all.samples, std::back_inserter(times), &Sample::time);
  EXPECT_EQ(times, (std::vector<double>{ 3.0, 4.0, 9.0, 9.5, 10.5, 10.75 }));
}

} // namespace
} // namespace palp
