#include "app/press/presses.h"

#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/csv_table.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kModulus = 50e3 / (1.0 - 0.33 * 0.33); // [Pa]
constexpr double kRadius = 10.0_mm;

// a sphere on a block, as deep as told at each millisecond
Recording pressed(const std::vector<double>& depths)
{
  Recording recording;
  recording.scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 20)));
  recording.scene.law = ForceLaw(SphereTip{ kRadius }, Material{ 50.0_kPa, 0.33 });
  for (const double depth : depths)
  {
    Sample& sample =
      recording.samples.emplace_back(step(recording.scene, { .apex = { 0.0, 0.0, -depth } }));
    sample.time = 1e-3 * static_cast<double>(recording.samples.size() - 1);
  }
  return recording;
}

// down to a depth and up again, a thousandth of it a step
void appendPress(std::vector<double>& depths, double deepest)
{
  for (int i = -50; i <= 1000; ++i)
  {
    depths.push_back(1e-3 * i * deepest);
  }
  for (int i = 999; i >= -50; --i)
  {
    depths.push_back(1e-3 * i * deepest);
  }
}

// a tool that follows a pointer which jumps is up for a moment
TEST(Presses, AreTwoWhereTheToolComesDownElsewhereAtOnce)
{
  for (const double far : { 8.0_mm, 30.0_mm })
  {
    Recording recording = pressed({});
    for (int i = 0; i < 600; ++i)
    {
      const bool lifts = i >= 300 && i < 313;
      const ToolPose pose{ .apex = { i < 306 ? 0.0 : far, 0.0, lifts ? 1.0_mm : -3.0_mm } };
      recording.samples.push_back(step(recording.scene, pose));
      recording.samples.back().time = 1e-3 * i;
    }
    const auto presses = findPresses(recording);
    ASSERT_EQ(presses.size(), far > 2.0 * kRadius ? 2U : 1U) << "else it is a bounce";
  }
}

// Hertz: F = k d^1.5, so that the work is 2/5 F d and the stiffness 3/2 F / d
TEST(Presses, HaveTheFiguresOfHertz)
{
  std::vector<double> depths;
  appendPress(depths, 5.0_mm);
  appendPress(depths, 2.0_mm);
  const auto presses = findPresses(pressed(depths));
  ASSERT_EQ(presses.size(), 2U);
  const double k = 4.0 / 3.0 * kModulus * std::sqrt(kRadius);
  for (std::size_t i = 0; i < 2; ++i)
  {
    const double depth = i == 0 ? 5.0_mm : 2.0_mm;
    const double force = k * std::pow(depth, 1.5);
    EXPECT_NEAR(presses[i].deepest.depth, depth, 1e-9);
    EXPECT_NEAR(presses[i].force, force, 1e-6 * force);
    EXPECT_NEAR(presses[i].energy, 0.4 * force * depth, 1e-4 * force * depth);
    EXPECT_NEAR(presses[i].end - presses[i].begin, 1.998, 1e-6);
  }
  ASSERT_TRUE(presses[0].stiffness.has_value());
  const double atNewton = std::pow(1.0 / k, 2.0 / 3.0); // depth
  EXPECT_NEAR(*presses[0].stiffness, 1.5 / atNewton, 1e-4 * 1.5 / atNewton);
  EXPECT_FALSE(presses[1].stiffness.has_value()); // 0.67 N
  EXPECT_EQ(presses[0].name, "press 1");
}

// a recording that begins with the tool in the tissue tells what was done from there: the work of
// Hertz between the two depths, and no stiffness at a force that was passed before
TEST(Presses, OfARecordingThatBeginsInTheTissueHaveTheWorkFromThere)
{
  const double k = 4.0 / 3.0 * kModulus * std::sqrt(kRadius);
  const auto work = [k](double depth) { return 0.4 * k * std::pow(depth, 2.5); };
  for (const double first : { 1.0_mm, 4.0_mm })
  {
    std::vector<double> depths;
    for (int i = 0; i <= 500; ++i)
    {
      depths.push_back(first + i * (6.0_mm - first) / 500);
    }
    const auto presses = findPresses(pressed(depths));
    ASSERT_EQ(presses.size(), 1U);
    EXPECT_NEAR(presses[0].energy, work(6.0_mm) - work(first), 1e-4 * work(6.0_mm));
    EXPECT_EQ(presses[0].stiffness.has_value(), first < 2.0_mm); // 0.24 N and 1.9 N at first
  }
}

// as fast as 1 to 3 m/s, so that the first sample is far below the surface, without one above it
TEST(Presses, OfFewSamplesHaveTheFiguresOfHertz)
{
  const double k = 4.0 / 3.0 * kModulus * std::sqrt(kRadius);
  const double stiffness = 1.5 * k * std::sqrt(std::pow(1.0 / k, 2.0 / 3.0));
  for (const double step : { 1.0_mm, 3.0_mm })
  {
    const auto presses = findPresses(pressed({ step, 2.0 * step }));
    ASSERT_EQ(presses.size(), 1U);
    const double first = 0.4 * k * std::pow(step, 2.5);
    const double trapezoid = 0.5 * k * (1.0 + std::sqrt(8.0)) * std::pow(step, 2.5);
    EXPECT_NEAR(presses[0].energy, first + trapezoid, 1e-6 * trapezoid);
    if (k * std::pow(step, 1.5) > 1.0) // reached before the first sample
    {
      ASSERT_TRUE(presses[0].stiffness.has_value());
      EXPECT_NEAR(*presses[0].stiffness, stiffness, 1e-6 * stiffness);
    }
  }
}

TEST(Presses, ABounceEndsNone)
{
  const auto countOf = [](std::size_t apart)
  {
    std::vector<double> depths(50, 1.0_mm);
    depths.insert(depths.end(), apart, -1.0_mm);
    depths.insert(depths.end(), 50, 2.0_mm);
    return findPresses(pressed(depths)).size();
  };
  EXPECT_EQ(countOf(5), 1U);
  EXPECT_EQ(countOf(30), 2U);
}

// the samples of some milliseconds are missing, as where a servo skips
Recording without(Recording recording, std::ptrdiff_t from, std::ptrdiff_t count)
{
  const auto first = recording.samples.begin() + from;
  recording.samples.erase(first, first + count);
  return recording;
}

// every so many milliseconds, as somebody may thin a table
Recording eachOf(Recording recording, std::size_t step, std::size_t from)
{
  std::vector<Sample> kept;
  for (std::size_t i = from; i < recording.samples.size(); i += step)
  {
    kept.push_back(recording.samples[i]);
  }
  recording.samples = std::move(kept);
  return recording;
}

// to a depth and, on a line, to the next, each in so many milliseconds
std::vector<double> along(const std::vector<std::pair<double, int>>& knots)
{
  std::vector<double> depths;
  double from = -1.0_mm;
  for (const auto& [depth, time] : knots)
  {
    for (int i = 0; i < time; ++i)
    {
      depths.push_back(from + (depth - from) * i / time);
    }
    from = depth;
  }
  return depths;
}

// 3.3 mm deep, at rest, on the way down and on the way up
TEST(Presses, AServoThatSkipsAtADepthEndsNone)
{
  const Recording whole =
    pressed(along({ { 3.3_mm, 430 }, { 3.3_mm, 500 }, { -1.0_mm, 430 }, { -1.0_mm, 50 } }));
  const PressSummary expected = findPresses(whole).at(0);
  for (const int from : { 150, 300, 420, 500, 700, 900, 1000, 1100 })
  {
    for (const int count : { 19, 24, 60, 110 })
    {
      const auto presses = findPresses(without(whole, from, count));
      ASSERT_EQ(presses.size(), 1U) << count << " ms from " << from << " ms on";
      EXPECT_EQ(presses[0].begin, expected.begin);
      EXPECT_EQ(presses[0].end, expected.end);
      EXPECT_NEAR(presses[0].force, expected.force, 1e-12);
      EXPECT_NEAR(presses[0].energy, expected.energy, 0.1 * expected.energy) << from;
    }
  }
}

// a device that tells places to 0.06 mm jumps between two of them
TEST(Presses, TheStepsOfADeviceAreNoMotion)
{
  std::vector<double> depths = along({ { 1.0_mm, 200 }, { 1.0_mm, 400 }, { -1.0_mm, 200 } });
  for (std::size_t i = 200; i < 600; ++i)
  {
    depths[i] += i % 3 == 0 ? 0.06_mm : 0.0;
  }
  EXPECT_EQ(findPresses(without(pressed(depths), 400, 80)).size(), 1U);
}

// apart for 80 ms, of which no sample is left
TEST(Presses, ALiftThatAServoSkippedEndsOne)
{
  const Recording whole = pressed(along(
    { { 3.0_mm, 400 }, { -0.4_mm, 340 }, { -0.4_mm, 2 }, { 3.0_mm, 340 }, { -1.0_mm, 400 } }));
  ASSERT_EQ(findPresses(whole).size(), 2U);
  EXPECT_EQ(findPresses(without(whole, 698, 86)).size(), 2U);  // from near the surface
  EXPECT_EQ(findPresses(without(whole, 660, 162)).size(), 2U); // from 0.4 mm
  const Recording bounce = pressed(along({ { 3.0_mm, 400 }, { -0.05_mm, 305 }, { 3.0_mm, 305 } }));
  ASSERT_EQ(findPresses(bounce).size(), 1U);
  EXPECT_EQ(findPresses(without(bounce, 699, 13)).size(), 1U);
  EXPECT_EQ(findPresses(without(bounce, 690, 31)).size(), 1U); // from 0.1 mm: no time to lift
}

TEST(Presses, OfAThinnedRecordingAreThoseOfTheWhole)
{
  const Recording lifted = pressed(along({ { 3.0_mm, 4000 }, { -0.1_mm, 3100 }, { 3.0_mm, 3100 },
    { 0.1_mm, 2900 }, { 3.0_mm, 2900 }, { -1.0_mm, 4000 } })); // once apart, once nearly so
  ASSERT_EQ(findPresses(lifted).size(), 2U);
  for (const double interval : { 0.1, 0.8, 3.2 })
  {
    Recording thinned = lifted;
    thinned.interval = interval;
    thin(thinned);
    ASSERT_LT(thinned.samples.size(), 400 / interval);
    EXPECT_EQ(findPresses(thinned).size(), 2U) << interval;
    keepContact(thinned);
    EXPECT_EQ(findPresses(thinned).size(), 2U) << interval;
  }
}

// rows of 0.1 s, whatever their phase, none of which may show the tool apart
TEST(Presses, OfATableOfFewRowsAreTold)
{
  const Recording lifted = pressed(along(
    { { 3.0_mm, 400 }, { -0.45_mm, 345 }, { 3.0_mm, 345 }, { -1.0_mm, 400 }, { -1.0_mm, 99 } }));
  const Recording held = pressed(along(
    { { 3.0_mm, 400 }, { 0.3_mm, 270 }, { 0.3_mm, 400 }, { 3.0_mm, 270 }, { -1.0_mm, 400 } }));
  for (std::size_t phase = 0; phase < 100; phase += 7)
  {
    EXPECT_EQ(findPresses(eachOf(lifted, 100, phase)).size(), 2U) << phase;
    EXPECT_EQ(findPresses(eachOf(held, 100, phase)).size(), 1U) << phase;
  }
}

// five a second, 2 mm deep, apart for 80 ms each
TEST(Presses, FastTapsAreOneEachWhateverIsSkipped)
{
  std::vector<double> depths(100, -1.0_mm);
  for (int i = 0; i < 1000; ++i)
  {
    depths.push_back(2.0_mm - 3.2_mm * std::pow(std::cos(i * 5e-3 * std::numbers::pi), 2));
  }
  depths.insert(depths.end(), 100, -1.0_mm);
  const Recording taps = pressed(depths);
  ASSERT_EQ(findPresses(taps).size(), 5U);
  EXPECT_EQ(findPresses(without(taps, 385, 30)).size(), 5U); // at the deepest of the second
  for (int from = 425; from < 460; from += 5)
  {
    EXPECT_EQ(findPresses(without(taps, from, 2 * (500 - from))).size(), 5U) << from; // a lift
  }
}

// what is pressed again on the same way is work given back and done once more
TEST(Presses, WorkIsThatOfTheWayToTheLargestDepth)
{
  std::vector<double> depths;
  for (const auto& [from, to] : { std::pair(0, 400), std::pair(400, 200), std::pair(200, 500) })
  {
    for (int i = from; i != to; i += to > from ? 1 : -1)
    {
      depths.push_back(i * 0.01_mm);
    }
  }
  depths.push_back(5.0_mm);
  const auto presses = findPresses(pressed(depths));
  ASSERT_EQ(presses.size(), 1U);
  EXPECT_NEAR(presses[0].energy, 0.4 * presses[0].force * 5.0_mm, 1e-3 * presses[0].energy);
}

TEST(Presses, AreATableWithToolAndLaw)
{
  std::vector<double> depths;
  appendPress(depths, 5.0_mm);
  appendPress(depths, 9.0_mm);
  Recording recording = pressed(depths);
  recording.names = { "a \"b\", c" };
  std::ostringstream out;
  writePresses(out, recording);
  const std::string text = out.str();
  EXPECT_NE(text.find("\n\"a \"\"b\"\", c\",0.05"), std::string::npos) << text;
  EXPECT_NE(text.find("\n\"press 2\","), std::string::npos) << text;
  EXPECT_NE(text.find("\"sphere:10mm\",50,0.33,\"paper"), std::string::npos) << text;
  const std::size_t second = text.find("\"press 2\"");
  EXPECT_EQ(text.substr(0, second).find("depth\""), std::string::npos) << text; // of 0.55 R
  EXPECT_NE(text.substr(second).find("depth"), std::string::npos) << text;
  recording.rated = false;
  std::ostringstream unrated;
  writePresses(unrated, recording);
  EXPECT_EQ(unrated.str().find(",outside_limits\n"), std::string::npos);
}

} // namespace
} // namespace palp
