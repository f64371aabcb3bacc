#include "haptics/force/force_law.h"

#include "haptics/error.h"
#include "haptics/units.h"
#include "tests/haptics/force/tips.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;

const Material kLiver{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };

// Hertz in terms of E* = E / (1 - nu^2), another road to Eq. (4)
TEST(PaperLaw, SphereIsHertz)
{
  for (const double nu : { 0.0, 0.33, 0.5 })
  {
    const ForceLaw law(SphereTip{ 6.0_mm }, Material{ 50.0_kPa, nu });
    for (const double depth : { 0.01_mm, 1.0_mm, 6.0_mm, 20.0_mm })
    {
      const double hertz =
        4.0 / 3.0 * 50.0_kPa / (1.0 - nu * nu) * std::sqrt(6.0_mm) * std::pow(depth, 1.5);
      EXPECT_NEAR(law({ .depth = depth }).force, hertz, 1e-12 * hertz);
    }
  }
}

// Sneddon 1965, at angles that tell alpha from its complement
TEST(PaperLaw, ConeIsSneddon)
{
  for (const double angle : { 30.0_deg, 45.0_deg, 60.0_deg })
  {
    const ForceLaw law(ConeTip{ angle, 10.0_mm }, kLiver);
    for (const double depth : { 0.01_mm, 1.0_mm, 8.0_mm })
    {
      const double sneddon =
        2.0 / std::numbers::pi * 50.0_kPa / (1.0 - 0.33 * 0.33) * std::tan(angle) * depth * depth;
      EXPECT_NEAR(law({ .depth = depth }).force, sneddon, 1e-12 * sneddon);
    }
  }
}

TEST(PaperLaw, HasTheExponentsOfHertzAndSneddon)
{
  const auto exponent = [](const ForceLaw& law)
  { return std::log2(law({ .depth = 4.0_mm }).force / law({ .depth = 2.0_mm }).force); };
  EXPECT_NEAR(exponent({ SphereTip{ 10.0_mm }, kLiver }), 1.5, 1e-12);
  EXPECT_NEAR(exponent({ ConeTip{ 45.0_deg, 10.0_mm }, kLiver }), 2.0, 1e-12);
}

// Eq. (2): r = (3 (1 - nu) F R / 8 G)^(1/3)
TEST(PaperLaw, ContactRadiusIsThatOfEquation2UpToTheBase)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kLiver);
  const Response response = law({ .depth = 5.0_mm });
  EXPECT_NEAR(response.contactRadius,
    std::cbrt(3.0 * 0.67 * response.force * 10.0_mm / (8.0 * kLiver.shearModulus())), 1e-15);
  EXPECT_EQ(law({ .depth = 15.0_mm }).contactRadius, 10.0_mm);
  EXPECT_EQ(
    ForceLaw(ConeTip{ 60.0_deg, 5.0_mm }, kLiver)({ .depth = 15.0_mm }).contactRadius, 5.0_mm);
}

TEST(PaperLaw, IsExactForOtherTips)
{
  const std::vector<Tip> tips = test::allTips();
  for (std::size_t i = 2; i < tips.size(); ++i)
  {
    const ForceLaw paper(tips[i], kLiver);
    const ForceLaw exact(tips[i], kLiver, { .mode = LawMode::Exact });
    EXPECT_EQ(paper({ .depth = 3.0_mm }).force, exact({ .depth = 3.0_mm }).force);
    EXPECT_GT(paper({ .depth = 3.0_mm }).force, 0.0);
  }
}

class AnyLaw : public ::testing::TestWithParam<std::tuple<Tip, LawMode>>
{
protected:
  ForceLaw law_{ std::get<0>(GetParam()), kLiver, { .mode = std::get<1>(GetParam()) } };
};
INSTANTIATE_TEST_SUITE_P(ForceLaw, AnyLaw,
  ::testing::Combine(
    ::testing::ValuesIn(test::allTips()), ::testing::Values(LawMode::Paper, LawMode::Exact)));

TEST_P(AnyLaw, PushesBackOnlyInContact)
{
  for (const double depth : { 0.0, -1.0_mm, std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity() })
  {
    const Response none = law_({ .depth = depth });
    EXPECT_EQ(none.force, 0.0);
    EXPECT_EQ(none.contactRadius, 0.0);
    EXPECT_EQ(none.stiffness, 0.0);
  }
  EXPECT_GT(law_({ .depth = 1.0_mm }).force, 0.0);
}

TEST_P(AnyLaw, BeginsAtZeroAndIsMonotone)
{
  double force = 0.0;
  double stiffness = 0.0;
  EXPECT_LT(law_({ .depth = 1e-12 }).force, 1e-6);
  for (double depth = 1e-9; depth < 50.0_mm; depth *= 1.05)
  {
    const Response response = law_({ .depth = depth });
    EXPECT_GT(response.force, force);
    EXPECT_GE(response.stiffness, stiffness * (1.0 - 1e-12));
    force = response.force;
    stiffness = response.stiffness;
  }
}

// a flat punch of the tip's flat at first touch; nothing under a point
TEST_P(AnyLaw, BeginsWithTheSlopeOfItsFlat)
{
  const double flat = 2.0 * kLiver.contactModulus() * flatRadius(law_.tip());
  EXPECT_NEAR(law_({ .depth = 1e-12 }).stiffness, flat, 1e-6 * flat + 0.02);
}

// C1: the stated stiffness is the derivative everywhere and has no jumps
TEST_P(AnyLaw, StiffnessIsTheDerivativeOfTheForce)
{
  // the table of a profile rounds its corners
  const double tolerance = std::holds_alternative<ProfileTip>(law_.tip()) ? 2e-3 : 1e-6;
  for (double depth = 0.02_mm; depth < 30.0_mm; depth *= 1.07)
  {
    const double h = 1e-5 * depth;
    const double numeric =
      (law_({ .depth = depth + h }).force - law_({ .depth = depth - h }).force) / (2.0 * h);
    EXPECT_NEAR(law_({ .depth = depth }).stiffness, numeric, tolerance * numeric) << depth;
  }
}

// quasi-static and linear in E: 1.5 MPa is 30 times 50 kPa
TEST_P(AnyLaw, ScalesWithYoungsModulus)
{
  const ForceLaw stiff(law_.tip(), Material{ 1.5_MPa, 0.33 }, law_.settings());
  EXPECT_NEAR(
    stiff({ .depth = 2.0_mm }).force / law_({ .depth = 2.0_mm }).force, 30.0, 30.0 * 1e-12);
}

TEST(ForceLaw, RefusesWhatItsPartsRefuse)
{
  EXPECT_THROW(ForceLaw(SphereTip{ 0.0 }, kLiver), Error);
  EXPECT_THROW(ForceLaw(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.51 }), Error);
  EXPECT_NO_THROW(ForceLaw(SphereTip{ 10.0_mm }, Material{ 50.0_kPa, 0.5 }));
}

} // namespace
} // namespace palp
