#include "app/press/presses.h"

#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/csv_table.h"
#include "tests/support/surfaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

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
