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
  EXPECT_NEAR(found.numbers.column("cone_force_change_percent")[9], 4.5, 0.1);
  EXPECT_NEAR(
    found.numbers.column("sphere_normal_loss_percent")[21], 6.64, 0.01); // 1 - cos 21 degrees
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
      EXPECT_GT(figures::pointsOf(found.points, curve).x.size(), 8U);
    }
    EXPECT_EQ(figure.curves[0].label, "finite elements");
    EXPECT_EQ(figure.curves[3].label, ""); // named once
  }
}

TEST(Experiments, TablesCarryTheirFindingAboveTheColumns)
{
  const Experiment two{ .numbers = { .name = "two",
                          .caption = {},
                          .columns = { "a_mm", "b_N" },
                          .rows = { { 1.0, NAN }, { 3.0, 0.5 } } },
    .finding = "Yes." };
  EXPECT_EQ(csv(two), "# Yes.\na_mm,b_N\n1,\n3,0.5\n");
}

} // namespace
} // namespace palp::fem
