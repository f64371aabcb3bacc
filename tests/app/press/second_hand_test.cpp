#include "app/press/export.h"
#include "app/press/recorded_rows.h"
#include "haptics/devices/simulated/scripted_path.h"
#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/servo/servo_step.h"
#include "haptics/units.h"
#include "tests/support/process.h"
#include "tests/support/surfaces.h"

#include <array>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>
#include <string>

namespace palp
{
namespace
{

using namespace units::literals;

// two tools pressed side by side into a block, the second half a millisecond after the first
Recording pressedBy(double apart, int count = 40)
{
  Recording recording;
  recording.device = "left arm";
  recording.scene.surface =
    std::make_shared<const Surface>(test::makeSurface(test::block({ 0.2, 0.2, 0.1 }, 8)));
  recording.second.emplace().device = "right arm";
  for (int i = 0; i < count; ++i)
  {
    for (const bool isFirst : { true, false })
    {
      Sample sample = step(recording.scene,
        { .apex = { isFirst ? 0.0 : apart, 0.0, (isFirst ? 1.0 : 2.0) * (0.5_mm - 0.1_mm * i) } });
      sample.time = 1e-3 * (isFirst ? i : i + 0.5);
      (isFirst ? recording.samples : recording.second->samples).push_back(sample);
    }
  }
  return recording;
}

// R_d is three times the depth
Calibration triple()
{
  return { .extents =
             ExtentTable({ { 0.01_mm, 0.03_mm, 0.0, 0.0 }, { 20.0_mm, 60.0_mm, 0.0, 0.0 } }),
    .style = {},
    .note = {},
    .elements = {},
    .young = {} };
}

class SecondHandFile : public testing::Test
{
protected:
  [[nodiscard]] std::filesystem::path write(const Recording& recording) const
  {
    const std::filesystem::path file = folder_.path() / "samples.csv";
    const Calibration calibration = triple();
    writeSamples(file, recording, &calibration);
    return file;
  }

  test::TemporaryFolder folder_;
};

TEST_F(SecondHandFile, IsReadBackAsItWasRecorded)
{
  const Recording made = pressedBy(50.0_mm);
  Recording again = pressedBy(50.0_mm, 0);
  again.second.reset();
  const std::filesystem::path file = write(made);
  readRows(again, file);
  ASSERT_TRUE(again.second);
  EXPECT_EQ(again.second->device, "right arm");
  for (const bool isFirst : { true, false })
  {
    const std::vector<Sample>& was = isFirst ? made.samples : made.second->samples;
    const std::vector<Sample>& is = isFirst ? again.samples : again.second->samples;
    ASSERT_EQ(is.size(), was.size());
    for (std::size_t i = 0; i < is.size(); ++i)
    {
      EXPECT_EQ(is[i].time, was[i].time);
      EXPECT_EQ(is[i].pose.apex, was[i].pose.apex);
      EXPECT_EQ(is[i].force, was[i].force);
    }
  }
  std::ostringstream first;
  std::ostringstream second;
  again.device = made.device;
  writeSamples(first, made, nullptr);
  writeSamples(second, again, nullptr);
  EXPECT_EQ(first.str(), second.str());
}

TEST_F(SecondHandFile, WhatFollowsOneToolFollowsTheFirst)
{
  const Recording made = pressedBy(50.0_mm);
  const std::filesystem::path file = write(made);
  const ScriptedPath path = readPath(file);
  EXPECT_EQ(path.knots().size(), made.samples.size());
  EXPECT_EQ(path.knots().back().apex, made.samples.back().pose.apex);
  const NumberTable table = NumberTable::readRecording(file, std::array{ "depth_mm", "force_N" });
  ASSERT_EQ(table.rows.size(), made.samples.size());
  EXPECT_EQ(table.rows.back().values.size(), 2U);
  EXPECT_NEAR(table.rows.back().values[0], 1e3 * made.samples.back().contact.depth, 1e-9);
}

TEST_F(SecondHandFile, ARowOfAThirdHandIsRefusedWithItsLine)
{
  const std::filesystem::path file = write(pressedBy(50.0_mm, 2));
  std::string text = test::readAll(file.string());
  text.replace(text.rfind(",2,"), 3, ",3,");
  std::ofstream(file) << text;
  Recording again = pressedBy(50.0_mm, 0);
  try
  {
    readRows(again, file);
    FAIL();
  }
  catch (const Error& error)
  {
    EXPECT_NE(std::string(error.what()).find("give 1 or 2"), std::string::npos) << error.what();
  }
}

// at 3.4 and 6.8 mm, whose R_d are 10.2 and 20.4 mm
TEST(BetweenHands, TwoContactsNearerThanTheirExtentsTogetherBreakARule)
{
  const Calibration calibration = triple();
  for (const auto& [apart, holds] : { std::pair(30.7_mm, true), { 30.5_mm, false } })
  {
    const Recording made = pressedBy(apart);
    const Sample& first = made.samples.back();
    const Sample& second = made.second->samples.back();
    ASSERT_NEAR(first.contact.depth, 3.4_mm, 1e-9);
    ASSERT_NEAR(second.contact.depth, 6.8_mm, 1e-9);
    EXPECT_EQ(betweenRule(calibration, first, second).holds(), holds) << apart;
    EXPECT_NEAR(betweenRule(calibration, second, first).value, 30.6_mm / apart, 1e-9);
    Sample elsewhere = second;
    elsewhere.organ = 1;
    EXPECT_TRUE(betweenRule(calibration, first, elsewhere).holds());
    EXPECT_TRUE(betweenRule(calibration, first, Sample{}).holds());
  }
}

// the last rule of the list, in the rows of both hands
TEST_F(SecondHandFile, RowsTellWhetherTheContactsMeet)
{
  for (const double apart : { 20.0_mm, 90.0_mm })
  {
    const std::filesystem::path file = write(pressedBy(apart));
    const std::string text = test::readAll(file.string());
    std::istringstream lines(text);
    double bit = 0.0;
    std::size_t column = 0;
    std::string last;
    for (std::string line; std::getline(lines, line); last = line)
    {
      const std::size_t at = line.find(" hands: two contacts");
      bit = at != std::string::npos ? std::stod(line.substr(1)) : bit;
      if (line.starts_with("time_s"))
      {
        const auto before = line.substr(0, line.find("broken_rules"));
        column = static_cast<std::size_t>(std::ranges::count(before, ','));
      }
    }
    ASSERT_GT(bit, 0.0);
    std::istringstream cells(last);
    std::string cell;
    for (std::size_t i = 0; i <= column; ++i)
    {
      std::getline(cells, cell, ',');
    }
    const auto broken = static_cast<std::uint32_t>(std::stod(cell));
    EXPECT_EQ((broken & static_cast<std::uint32_t>(bit)) != 0, apart < 30.0_mm) << last;
  }
}

} // namespace
} // namespace palp
