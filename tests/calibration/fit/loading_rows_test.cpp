#include "calibration/fit/loading_rows.h"

#include "haptics/error.h"

#include <gtest/gtest.h>
#include <vector>

namespace palp::fit
{
namespace
{

void expectRows(const std::vector<double>& depths, std::size_t first, std::size_t count)
{
  const Rows rows = loadingRows(depths);
  EXPECT_EQ(rows.first, first);
  EXPECT_EQ(rows.count, count);
}

TEST(LoadingRows, AreAllWhereTheToolOnlyGoesIn)
{
  expectRows({ -2, -1, 0, 1, 2, 3 }, 0, 6);
}

TEST(LoadingRows, EndAtTheDeepest)
{
  expectRows({ 0, 1, 2, 3, 3, 3, 2, 1, 0 }, 0, 4);
}

TEST(LoadingRows, BeginWhereTheToolLastTurned)
{
  // two presses, the second one deeper, with a way in the air between
  expectRows({ 0, 2, 4, 2, 0, 0, 1, 3, 5, 2 }, 4, 5);
}

TEST(LoadingRows, HoldNoiseOfTheDepth)
{
  expectRows({ 0.0, 0.1, 0.05, 1.0, 0.95, 2.0, 1.9, 3.0 }, 0, 8);
}

TEST(LoadingRows, AreRefusedWhereThereAreNone)
{
  for (const std::vector<double>& depths :
    { std::vector<double>{}, { 1.0, 1.0, 1.0 }, { 3.0, 2.0, 1.0 }, { 1.0 } })
  {
    EXPECT_THROW((void)loadingRows(depths), Error);
  }
}

} // namespace
} // namespace palp::fit
