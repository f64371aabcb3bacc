#include "calibration/experiments.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp::fem
{
namespace
{

// Eq. (7), and boundary elements: 4.5 % at 9 degrees
TEST(Experiments, InclinationFollowsEquationSeven)
{
  const Experiment found = inclination();
  EXPECT_NEAR(found.rows[9][2], 4.5, 0.1);
  EXPECT_NEAR(found.rows[21][1], 6.64, 0.01); // 1 - cos 21 degrees
  EXPECT_NE(found.finding.find("21.57"), std::string::npos);
}

TEST(Experiments, TablesCarryTheirFindingAboveTheColumns)
{
  const Experiment two{ .name = "two",
    .columns = { "a_mm", "b_N" },
    .rows = { { 1, NAN }, { 3, 0.5 } },
    .figures = {},
    .finding = "Yes." };
  EXPECT_EQ(csv(two), "# Yes.\na_mm,b_N\n1,\n3,0.5\n");
}

} // namespace
} // namespace palp::fem
