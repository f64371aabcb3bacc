#include "calibration/experiments/experiments.h"

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

// four depths, three curves each; the fitted one is the closer
TEST(Experiments, QuickProfilesDrawEveryCurve)
{
  const Experiment found = profiles(Resolution::Quick);
  ASSERT_EQ(found.figures.size(), 2U);
  for (const Figure& figure : found.figures)
  {
    ASSERT_EQ(figure.curves.size(), 12U);
    for (const Curve& curve : figure.curves)
    {
      EXPECT_EQ(curve.x.size(), curve.y.size());
      EXPECT_GT(curve.x.size(), 8U);
    }
    EXPECT_EQ(figure.curves[0].name, "finite elements");
    EXPECT_EQ(figure.curves[3].name, ""); // named once
  }
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
