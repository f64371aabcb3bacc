#include "haptics/tip/tip.h"

#include "haptics/error.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/haptics/force/tips.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;

class AnyTip : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(Tip, AnyTip, ::testing::ValuesIn(test::allTips()));

TEST_P(AnyTip, RisesFromItsApexAndStaysAtItsBase)
{
  const Tip& tip = GetParam();
  const double base = baseRadius(tip);
  EXPECT_EQ(tipHeight(tip, 0.0), 0.0);
  double previous = 0.0;
  for (int i = 1; i <= 100; ++i)
  {
    const double height = tipHeight(tip, base * i / 100.0);
    EXPECT_GE(height, previous);
    previous = height;
  }
  EXPECT_EQ(tipHeight(tip, 2.0 * base), tipHeight(tip, base));
}

TEST_P(AnyTip, SlopeIsTheDerivativeOfTheHeight)
{
  const Tip& tip = GetParam();
  const double base = baseRadius(tip);
  for (int i = 1; i < 60; ++i)
  {
    const double r = base * (i + 0.37) / 61.0;
    const double h = 1e-6 * base;
    const double numeric = (tipHeight(tip, r + h) - tipHeight(tip, r - h)) / (2.0 * h);
    EXPECT_NEAR(tipSlope(tip, r), numeric, 1e-6 * (1.0 + numeric)) << "r = " << r;
  }
}

TEST_P(AnyTip, PassesTheCheck)
{
  EXPECT_NO_THROW((void)checkedTip(GetParam()));
}

TEST(Tip, SphereHasAFiniteSlopeAtItsEquator)
{
  EXPECT_EQ(tipSlope(SphereTip{ 10.0_mm }, 10.0_mm), 1e6);
  EXPECT_DOUBLE_EQ(tipHeight(SphereTip{ 10.0_mm }, 10.0_mm), 10.0_mm);
}

TEST(Tip, BluntConeIsTangentWhereCapAndFlankMeet)
{
  const BluntConeTip tip{ 60.0_deg, 3.0_mm, 10.0_mm };
  const double tangent = 3.0_mm * std::cos(60.0_deg);
  EXPECT_NEAR(tipSlope(tip, tangent * (1.0 - 1e-9)), tipSlope(tip, tangent), 1e-8);
}

TEST(Tip, RefusesDimensionsOutOfRange)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Tip> wrong{ SphereTip{ 0.09_mm }, SphereTip{ 1001.0_mm }, SphereTip{ nan },
    ConeTip{ 0.9_deg, 10.0_mm }, ConeTip{ 89.1_deg, 10.0_mm }, ConeTip{ 45.0_deg, -1.0_mm },
    PunchTip{ 0.0 }, TruncatedConeTip{ 45.0_deg, 10.0_mm, 10.0_mm },
    TruncatedConeTip{ 45.0_deg, 0.0, 10.0_mm }, BluntConeTip{ 60.0_deg, 20.0_mm, 10.0_mm },
    BluntConeTip{ 60.0_deg, nan, 10.0_mm }, ParaboloidTip{ 0.0 }, ProfileTip{ nullptr },
    ProfileTip{ std::make_shared<const Profile>(
      std::vector<Profile::Point>{ { 0.0, 0.0 }, { 1.0_um, 1.0_um }, { 2.0_um, 3.0_um } }) } };
  for (std::size_t i = 0; i < wrong.size(); ++i)
  {
    EXPECT_THROW((void)checkedTip(wrong[i]), Error) << "tip " << i;
  }
}

TEST(Tip, RefusalNamesTheDimensionAndItsRange)
{
  try
  {
    (void)checkedTip(SphereTip{ 0.05_mm });
    FAIL() << "accepted";
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    EXPECT_STREQ(error.what(), "radius of the sphere: 0.05 mm; give 0.1 mm to 1000 mm");
  }
}

TEST(Tip, AcceptsTheEndsOfTheRanges)
{
  EXPECT_NO_THROW((void)checkedTip(SphereTip{ 0.1_mm }));
  EXPECT_NO_THROW((void)checkedTip(SphereTip{ 1000.0_mm }));
  EXPECT_NO_THROW((void)checkedTip(ConeTip{ 1.0_deg, 0.1_mm }));
  EXPECT_NO_THROW((void)checkedTip(ConeTip{ 89.0_deg, 1000.0_mm }));
}

} // namespace
} // namespace palp
