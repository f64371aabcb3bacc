#include "app/press/recording.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace palp
