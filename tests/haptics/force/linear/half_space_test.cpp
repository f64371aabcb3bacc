#include "haptics/force/linear/half_space.h"

#include "haptics/force/linear/contact_depth.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/haptics/force/tips.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kBaseRadius = 1.0; // [m], wide enough never to matter

Tip tipOf(const std::string& model, double first, double second)
{
  if (model == "hertz")
  {
    return ParaboloidTip{ first };
  }
  if (model == "sneddon_sphere")
  {
    return SphereTip{ first };
  }
  if (model == "flat_punch")
  {
    return PunchTip{ first };
  }
  if (model == "cone")
  {
    return ConeTip{ first, kBaseRadius };
  }
  if (model == "trunc_cone")
  {
    return TruncatedConeTip{ first, second, kBaseRadius };
  }
  return BluntConeTip{ first, second, kBaseRadius };
}

struct Column
{
  const char* table;
  double tolerance; // relative
};

class ClosedForm : public ::testing::TestWithParam<Column>
{
};
// the first table is printed with ten digits; the second leaves the paraboloid's base out of reach
INSTANTIATE_TEST_SUITE_P(HalfSpace, ClosedForm,
  ::testing::Values(Column{ "halfspace_closed_forms", 1e-9 }, Column{ "halfspace_range", 1e-9 }));

TEST_P(ClosedForm, AgreesWithTheReference)
{
  const auto rows = test::referenceTable(GetParam().table);
  ASSERT_GE(rows.size(), 90U);
  std::map<std::string, double> worst;
  for (const auto& row : rows)
  {
    const std::string model = row.text("model");
    const double first = row.number("p1_m_or_rad");
    const double depth = row.number("delta_m");
    if (model == "hertz" && depth > first)
    {
      continue; // the reference knows no base
    }
    const double second = row.text("p2_m_or_rad").empty() ? 0.0 : row.number("p2_m_or_rad");
    const HalfSpace law(tipOf(model, first, second));
    const double nu = row.number("nu");
    const double force = row.number("E_Pa") / (1.0 - nu * nu) * law(depth).force;
    const double error = std::abs(force / row.number("F_N") - 1.0);
    EXPECT_LE(error, GetParam().tolerance) << model << " " << first << " " << depth;
    EXPECT_NEAR(law(depth).radius / row.number("a_m"), 1.0, 1e-7) << model << " " << depth;
    worst[model] = std::max(worst[model], error);
  }
  EXPECT_EQ(worst.size(), 6U);
  for (const auto& [model, error] : worst)
  {
    RecordProperty(model, std::to_string(error * 1e12) + "e-12");
  }
}

class AnyTipOnAHalfSpace : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(
  HalfSpace, AnyTipOnAHalfSpace, ::testing::ValuesIn(test::closedFormTips()));

// dF/ddepth = 2 E* a, beyond the base as before it
TEST_P(AnyTipOnAHalfSpace, StiffnessIsTwiceTheContactRadius)
{
  const HalfSpace law(GetParam());
  for (double depth = 0.05_mm; depth < 60.0_mm; depth *= 1.3)
  {
    const double h = 1e-5 * depth;
    const double numeric = (law(depth + h).force - law(depth - h).force) / (2.0 * h);
    EXPECT_NEAR(numeric, 2.0 * law(depth).radius, 1e-6 * numeric) << depth;
  }
}

// each radius given by g is found again
TEST_P(AnyTipOnAHalfSpace, ContactRadiusInvertsTheContactDepth)
{
  const HalfSpace law(GetParam());
  const double base = baseRadius(GetParam());
  const double flat = flatRadius(GetParam());
  for (int i = 1; i < 50; ++i)
  {
    const double radius = flat + (base - flat) * i / 50.0;
    const double depth = contactDepth(GetParam(), radius);
    if (depth > 0.0)
    {
      EXPECT_NEAR(law(depth).radius, radius, 1e-9 * radius);
    }
  }
}

TEST_P(AnyTipOnAHalfSpace, ContactNeverLeavesTheBase)
{
  const HalfSpace law(GetParam());
  for (const double depth : { 1.0_mm, 10.0_mm, 100.0_mm, 1.0, 1e3 })
  {
    EXPECT_LE(law(depth).radius, baseRadius(GetParam()));
    EXPECT_TRUE(std::isfinite(law(depth).force));
  }
}

// the table that a profile uses and that layers need, against the closed forms
TEST_P(AnyTipOnAHalfSpace, TableAgreesWithTheClosedForm)
{
  const HalfSpace law(GetParam());
  const ContactTable table(GetParam());
  for (double depth = 1e-8; depth < std::min(table.baseDepth(), 50.0_mm); depth *= 1.37)
  {
    const auto entry = table(depth);
    EXPECT_NEAR(entry.force, law(depth).force, 1e-6 * law(depth).force) << depth;
    EXPECT_NEAR(entry.radius, law(depth).radius, 2e-4 * law(depth).radius) << depth;
  }
}

TEST(HalfSpace, SphereTendsToTheParaboloidAndLiesBelowItWhenDeep)
{
  const HalfSpace sphere(SphereTip{ 10.0_mm });
  const HalfSpace paraboloid(ParaboloidTip{ 10.0_mm });
  EXPECT_NEAR(sphere(1e-9).force / paraboloid(1e-9).force, 1.0, 1e-6);
  EXPECT_NEAR(paraboloid(10.0_mm).force / sphere(10.0_mm).force, 1.11, 0.005);
}

// the closed form's own limit: F = E* (2 R depth - R^2)
TEST(HalfSpace, SphereFarBelowItsEquatorIsAShaft)
{
  const HalfSpace sphere(SphereTip{ 1.0_mm });
  EXPECT_NEAR(sphere(30.0_mm).force, 2.0 * 1.0_mm * 30.0_mm - 1e-6, 1e-15);
}

TEST(HalfSpace, BluntConeTendsToSphereAndToCone)
{
  const HalfSpace big(BluntConeTip{ 45.0_deg, 50.0_mm, 1.0 });
  EXPECT_DOUBLE_EQ(big(1.0_mm).force, HalfSpace(SphereTip{ 50.0_mm })(1.0_mm).force);
  const HalfSpace sharp(ConeTip{ 45.0_deg, 1.0 });
  EXPECT_NEAR(
    HalfSpace(BluntConeTip{ 45.0_deg, 1.0_um, 1.0 })(10.0_mm).force / sharp(10.0_mm).force, 1.0,
    1e-4);
}

TEST(HalfSpace, TruncatedConeTendsToPunchAndToCone)
{
  const HalfSpace law(TruncatedConeTip{ 45.0_deg, 5.0_mm, 1.0 });
  EXPECT_NEAR(law(1e-7).force / HalfSpace(PunchTip{ 5.0_mm })(1e-7).force, 1.0, 1e-4);
  const HalfSpace narrow(TruncatedConeTip{ 45.0_deg, 1.0_um, 1.0 });
  EXPECT_NEAR(
    narrow(10.0_mm).force / HalfSpace(ConeTip{ 45.0_deg, 1.0 })(10.0_mm).force, 1.0, 3e-4);
}

} // namespace
} // namespace palp
