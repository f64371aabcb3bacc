#include "pipeline/model/sample_columns.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace palp
{
namespace
{

double signal(int i)
{
  return std::sin(0.01 * i) + 0.1 * std::sin(1.7 * i);
}

std::vector<SampleColumns::Column> columnsOf(const SampleColumns& columns)
{
  std::vector<SampleColumns::Column> all;
  columns.forEach([&](const SampleColumns::Column& column) { all.push_back(column); });
  return all;
}

TEST(SampleColumns, KeepsTheExtremesOfEveryColumnOfTheLastMinute)
{
  SampleColumns columns(60.0, 800);
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i)
  {
    columns.add(0.001 * i, signal(i));
  }
  const auto all = columnsOf(columns);
  ASSERT_EQ(all.size(), 800U);
  EXPECT_NEAR(all.front().start, 40.0, 0.1);
  for (const auto& column : all)
  {
    double least = 1e9;
    double largest = -1e9;
    for (int i = 0; i < kSamples; ++i)
    {
      if (0.001 * i >= column.start && 0.001 * i < column.start + 0.075)
      {
        least = std::min(least, signal(i));
        largest = std::max(largest, signal(i));
      }
    }
    EXPECT_EQ(column.least, least);
    EXPECT_EQ(column.largest, largest);
  }
}

// a part that moves on shows the same columns
TEST(SampleColumns, JoinsAPartToColumnsThatStay)
{
  SampleColumns columns(60.0, 12'000);
  constexpr int kSamples = 100'000;
  for (int i = 0; i < kSamples; ++i)
  {
    columns.add(0.001 * i, signal(i));
  }
  for (const double from : { 70.0, 70.003, 70.1 })
  {
    int inside = 0;
    columns.forEach(from, from + 10.0, 0.05,
      [&](const SampleColumns::Column& column)
      {
        const double index = column.start / 0.05;
        EXPECT_NEAR(index, std::round(index), 1e-6);
        const int first = static_cast<int>(std::lround(1000.0 * column.start));
        double least = 1e9;
        double largest = -1e9;
        for (int i = first; i < first + 50; ++i)
        {
          least = std::min(least, signal(i));
          largest = std::max(largest, signal(i));
        }
        EXPECT_EQ(column.least, least);
        EXPECT_EQ(column.largest, largest);
        inside += column.start >= from && column.start + 0.05 <= from + 10.0 ? 1 : 0;
      });
    EXPECT_GE(inside, 198);
    EXPECT_LE(inside, 200);
  }
}

TEST(SampleColumns, BeginsNarrowAndLosesNothingWhenItWidens)
{
  SampleColumns columns(60.0, 800);
  double largest = 0.0;
  for (int i = 0; i < 50'000; ++i)
  {
    const double value = i == 1234 ? 9.0 : signal(i);
    columns.add(0.001 * i, value);
    largest = std::max(largest, value);
    if (i == 3000)
    {
      EXPECT_GT(columnsOf(columns).size(), 600U); // 3 s in columns of under 5 ms
    }
  }
  double seen = 0.0;
  for (const auto& column : columnsOf(columns))
  {
    seen = std::max(seen, column.largest);
  }
  EXPECT_EQ(seen, largest);
}

TEST(SampleColumns, LeavesAGapWhereNothingWasMeasured)
{
  SampleColumns columns(60.0, 600);
  columns.add(0.0, 1.0);
  columns.add(50.0, 2.0);
  columns.add(1000.0, 3.0);
  const auto all = columnsOf(columns);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].least, 3.0);
}

// a press, then nothing for a while: a line through the extremes may not leave the zero in between
TEST(SampleColumns, EndWhereTheSignalEnds)
{
  for (const double lift : { 0.01, 0.02, 0.04, 0.3, 7.0 }) // the columns are as wide as 0.1 s
  {
    SampleColumns columns(60.0, 600);
    double time = 0.0;
    for (; time < 20.0; time += 1e-3) // presses, between which the tool rests
    {
      columns.add(time, std::max(0.0, std::sin(time / lift)));
    }
    columns.add(time, 0.0);
    const std::vector<SampleColumns::Column> all = columnsOf(columns);
    const SampleColumns::Column& last = all.back();
    EXPECT_EQ(last.isFalling ? last.least : last.largest, 0.0) << lift;
  }
  SampleColumns rising(60.0, 600);
  for (const double force : { 1.0, 0.0, 0.4, 2.0 })
  {
    rising.add(59.0, force);
  }
  EXPECT_FALSE(columnsOf(rising).back().isFalling);
}

TEST(SampleColumns, TakesNoValueThatIsNotFinite)
{
  SampleColumns columns(60.0, 600);
  columns.add(1.0, std::numeric_limits<double>::quiet_NaN());
  columns.add(std::numeric_limits<double>::infinity(), 1.0);
  columns.add(-1.0, 1.0);
  EXPECT_TRUE(columnsOf(columns).empty());
}

} // namespace
} // namespace palp
