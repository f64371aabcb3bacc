#include "haptics/force/inclination.h"

#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace palp
{
namespace
{

using namespace units::literals;

// Eq. (7)
TEST(Inclination, SphereReachesTheJustNoticeableDifferenceAt21Point6Degrees)
{
  EXPECT_NEAR(units::toDegrees(tiltOfShare(0.07)), 21.565, 0.001);
  EXPECT_NEAR(inclinedForce(2.0, tiltOfShare(0.07)).axial, 2.0 * 0.93, 1e-12);
}

TEST(Inclination, SplitsTheForceWithoutLosingAny)
{
  const InclinedForce split = inclinedForce(2.0, -30.0_deg);
  EXPECT_NEAR(std::hypot(split.axial, split.lateral), 2.0, 1e-15);
  EXPECT_NEAR(split.lateral, 1.0, 1e-15);
}

TEST(TiltFactor, AgreesWithTheBoundaryElements)
{
  const auto rows = test::referenceTable("tilted_cone_bem_halfspace");
  ASSERT_EQ(rows.size(), 10U);
  for (const auto& row : rows)
  {
    const double tilt = units::fromDegrees(row.number("tilt_deg"));
    const ConeTip cone{ units::fromDegrees(row.number("alpha_semi_deg")), 10.0_mm };
    // 22 degrees is no node of the table here
    EXPECT_NEAR(tiltFactor(cone, tilt), row.number("F_over_F0"), 1.5e-3) << row.number("tilt_deg");
    EXPECT_EQ(tiltFactor(cone, -tilt), tiltFactor(cone, tilt));
  }
}

// to the tenth of a degree with which those tilts are stated
TEST(TiltFactor, Reaches7PercentWhereTheBoundaryElementsDo)
{
  EXPECT_NEAR(tiltFactor(ConeTip{ 30.0_deg, 10.0_mm }, 12.8_deg), 1.07, 1.5e-3);
  EXPECT_NEAR(tiltFactor(ConeTip{ 45.0_deg, 10.0_mm }, 11.1_deg), 1.07, 1.5e-3);
  EXPECT_NEAR(tiltFactor(ConeTip{ 60.0_deg, 10.0_mm }, 7.9_deg), 1.07, 1.5e-3);
}

TEST(TiltFactor, LeavesASphereAlone)
{
  EXPECT_EQ(tiltFactor(SphereTip{ 10.0_mm }, 20.0_deg), 1.0);
}

TEST(TiltFactor, RisesAndStaysBeyondTheTable)
{
  const ConeTip cone{ 60.0_deg, 10.0_mm };
  double previous = 1.0;
  for (double tilt = 0.5_deg; tilt < 60.0_deg; tilt += 0.5_deg)
  {
    EXPECT_GE(tiltFactor(cone, tilt), previous);
    previous = tiltFactor(cone, tilt);
  }
  EXPECT_DOUBLE_EQ(previous, 2.0);
}

// its slope is a force along the surface, also where the table ends
TEST(TiltFactor, HasNoCorner)
{
  constexpr double kStep = 0.01_deg;
  for (const double halfAngle : { 30.0_deg, 45.0_deg, 60.0_deg })
  {
    const ConeTip cone{ halfAngle, 10.0_mm };
    double before = 0.0;
    for (double tilt = 0.0; tilt < 60.0_deg; tilt += kStep)
    {
      const double slope = (tiltFactor(cone, tilt + kStep) - tiltFactor(cone, tilt)) / kStep;
      EXPECT_NEAR(slope, before, 0.05) << tilt;
      before = slope;
    }
  }
}

} // namespace
} // namespace palp
