#include "haptics/force/linear/coated_body.h"

#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/linear/layer_contact.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "tests/haptics/force/tips.h"
#include "tests/support/allocation_guard.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
const Material kBody{ 10.0_kPa, 0.45 };

Coatings one(double thickness, const Material& material)
{
  Coatings coatings;
  coatings.add({ thickness, material });
  return coatings;
}

LayerContact coatedContact(
  const Tip& tip, const Coatings& coatings, const Material& body, Base base = Base::Bonded)
{
  return LayerContact(tip, body.poissonRatio, base).coated(coatings, body, base);
}

// Burmister 1943, two incompressible sheets: with N = (n - 1) / (n + 1), e = exp(-2 m),
// (1 + 4 N m e - N^2 e^2) / (1 - 2 N (1 + 2 m^2) e + N^2 e^2)
TEST(SurfaceCompliance, IsBurmistersForTwoIncompressibleSheets)
{
  for (const double n : { 1e-3, 0.2, 1.0, 5.0, 1e3 })
  {
    const Coatings coating = one(1.0_mm, { n * 10.0_kPa, 0.5 });
    for (const double m : { 1e-4, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 500.0 })
    {
      const double N = (n - 1.0) / (n + 1.0);
      const double e = std::exp(-2.0 * m);
      const double expected = (1.0 + 4.0 * N * m * e - N * N * e * e) /
        (1.0 - 2.0 * N * (1.0 + 2.0 * m * m) * e + N * N * e * e);
      EXPECT_NEAR(
        surfaceCompliance(m / 1.0_mm, coating.all(), { 10.0_kPa, 0.5 }, kInfinite, Base::Bonded) /
          expected,
        1.0, 1e-9)
        << "n " << n << " m " << m;
    }
  }
}

// long waves feel what is below, short ones the coating only
TEST(SurfaceCompliance, GoesFromThatOfTheBodyToThatOfTheCoating)
{
  const Coatings coating = one(2.0_mm, { 200.0_kPa, 0.3 });
  const double ratio = coating.all().front().material.contactModulus() / kBody.contactModulus();
  const auto compliance = [&](double k, double thickness, Base base)
  { return surfaceCompliance(k, coating.all(), kBody, thickness, base); };
  EXPECT_NEAR(compliance(1e-4, kInfinite, Base::Bonded), ratio, 1e-3 * ratio);
  EXPECT_NEAR(compliance(1e5, kInfinite, Base::Bonded), 1.0, 1e-12);
  EXPECT_NEAR(compliance(1e5, 30.0_mm, Base::Slip), 1.0, 1e-12);
  EXPECT_LT(compliance(1e-3, 30.0_mm, Base::Bonded), 1e-3);
  EXPECT_LT(compliance(10.0, 30.0_mm, Base::Bonded), compliance(10.0, 30.0_mm, Base::Slip));
}

// a sheet cut in two is the same sheet
TEST(SurfaceCompliance, DoesNotSeeAJointWithinAMaterial)
{
  const Material fat{ 3.0_kPa, 0.48 };
  const Coatings whole = one(3.0_mm, fat);
  Coatings cut = one(1.0_mm, fat);
  cut.add({ 2.0_mm, fat });
  for (double k = 1.0; k < 1e4; k *= 2.0)
  {
    EXPECT_NEAR(surfaceCompliance(k, cut.all(), kBody, 20.0_mm, Base::Bonded),
      surfaceCompliance(k, whole.all(), kBody, 20.0_mm, Base::Bonded), 1e-12);
  }
}

class AnyTipOnACoating : public ::testing::TestWithParam<Tip>
{
};
INSTANTIATE_TEST_SUITE_P(CoatedBody, AnyTipOnACoating, ::testing::ValuesIn(test::allTips()));

TEST_P(AnyTipOnACoating, CoatedWithItsOwnMaterialIsTheBodyAlone)
{
  double worst = 0.0;
  for (const auto& [nu, base] :
    { std::pair(0.0, Base::Slip), { 0.33, Base::Bonded }, { 0.5, Base::Bonded } })
  {
    const Material body{ 10.0_kPa, nu };
    const LayerContact plain(GetParam(), nu, base);
    const LayerContact coated = coatedContact(GetParam(), one(1.0_mm, body), body, base);
    for (const double thickness : { 12.0_mm, 17.0_mm, 23.0_mm, 50.0_mm, 200.0_mm, kInfinite })
    {
      for (const double depth : { 0.02_mm, 0.3_mm, 1.0_mm, 4.0_mm })
      {
        const double force = plain(depth, thickness, 0.0).force;
        worst = std::max(worst, std::abs(coated(depth, thickness, 0.0).force / force - 1.0));
      }
    }
  }
  EXPECT_LT(worst, 1e-4);
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
}

// over something hard a coating is nearly a bonded layer
TEST_P(AnyTipOnACoating, CoatingOnSomethingHardIsALayerOfItsThickness)
{
  const Material soft{ 1.0_kPa, 0.45 };
  const Material hard{ 900.0_kPa, 0.45 };
  const LayerContact coated = coatedContact(GetParam(), one(15.0_mm, soft), hard);
  const LayerContact layer(GetParam(), 0.45, Base::Bonded);
  for (const double depth : { 0.1_mm, 1.0_mm, 4.0_mm })
  {
    const double force = layer(depth, 15.0_mm, 0.0).force / 900.0;
    EXPECT_NEAR(coated(depth, kInfinite, 0.0).force, force, 5e-3 * force);
  }
}

// stiffer and softer, thin and thick, over fat and without
TEST_P(AnyTipOnACoating, StiffnessIsTheDerivativeOfTheForceAndNeverFalls)
{
  for (const double contrast : { 1e-3, 0.05, 10.0, 20.0 })
  {
    for (const double coating : { 0.5_mm, 5.0_mm })
    {
      Coatings coatings = one(coating, { contrast * 10.0_kPa, 0.45 });
      if (contrast == 10.0)
      {
        coatings.add({ 10.0_mm, { 6.0_kPa, 0.48 } });
      }
      const LayerContact law = coatedContact(GetParam(), coatings, kBody);
      for (const double thickness : { coating + 2.0_mm, coating + 5.0_mm, 60.0_mm, kInfinite })
      {
        double force = 0.0;
        for (double depth = 0.001_mm; depth < 20.0_mm; depth *= 1.13)
        {
          const double h = 1e-4 * depth;
          const double numeric =
            (law(depth + h, thickness, 0.0).force - law(depth - h, thickness, 0.0).force) /
            (2.0 * h);
          const LinearContact now = law(depth, thickness, 0.0);
          ASSERT_NEAR(now.stiffness, numeric, 2e-2 * numeric)
            << "contrast " << contrast << " coating " << coating << " of " << thickness << " depth "
            << depth;
          ASSERT_GT(now.force, force);
          force = now.force;
        }
      }
    }
  }
}

// under the stiffest skin that is taken, a little more depth is a little more contact
TEST_P(AnyTipOnACoating, ContactNeverJumps)
{
  for (const double skin : { 0.5_mm, 1.0_mm, 3.0_mm })
  {
    const LayerContact law = coatedContact(GetParam(), one(skin, { 200.0_kPa, 0.45 }), kBody);
    LinearContact before = law(0.5_mm, kInfinite, 0.0);
    for (int i = 1; i < 600; ++i)
    {
      const double depth = 0.5_mm + i * 0.02_mm;
      const LinearContact now = law(depth, kInfinite, 0.0);
      ASSERT_GT(now.force, before.force) << "skin " << skin << " depth " << depth;
      ASSERT_GE(now.radius, before.radius) << "skin " << skin << " depth " << depth;
      ASSERT_LE(now.radius, before.radius + 0.4_mm) << "skin " << skin << " depth " << depth;
      before = now;
    }
  }
}

TEST(CoatedLaw, LiesBetweenTheTwoTissues)
{
  const Material skin{ 100.0_kPa, 0.45 };
  LawSettings settings{ .mode = LawMode::Corrected };
  const ForceLaw inner(SphereTip{ 10.0_mm }, kBody, settings);
  const ForceLaw outer(SphereTip{ 10.0_mm }, skin, settings);
  settings.coatings = one(1.0_mm, skin);
  const ForceLaw coated(SphereTip{ 10.0_mm }, kBody, settings);
  double fraction = 1.0;
  for (const double depth : { 0.001_mm, 0.01_mm, 0.1_mm, 1.0_mm, 5.0_mm, 9.0_mm })
  {
    const double force = coated({ .depth = depth }).force;
    EXPECT_GT(force, inner({ .depth = depth }).force);
    EXPECT_LT(force, outer({ .depth = depth }).force);
    // the wider the contact, the less the skin tells
    EXPECT_LT(force / outer({ .depth = depth }).force, fraction);
    fraction = force / outer({ .depth = depth }).force;
  }
}

TEST(CoatedLaw, ItsFactorsMultiplyThePapersForce)
{
  LawSettings settings{ .mode = LawMode::Corrected, .coatings = one(2.0_mm, { 60.0_kPa, 0.4 }) };
  const ForceLaw law(SphereTip{ 10.0_mm }, kBody, settings);
  const ForceLaw paper(SphereTip{ 10.0_mm }, kBody);
  const ContactGeometry position{
    .depth = 3.0_mm, .thickness = 40.0_mm, .surfaceCurvature = 1.0 / 60.0_mm
  };
  double force = paper(position).force;
  for (const Factor& factor : law.factors(position))
  {
    force *= factor.value;
  }
  EXPECT_NEAR(law(position).force, force, 1e-9 * force);
  EXPECT_GT(law.factors(position)[6].value, 1.1);
  // a law without coatings of the same tissue has the same other factors
  settings.coatings = {};
  const Factors plain = ForceLaw(SphereTip{ 10.0_mm }, kBody, settings).factors(position);
  EXPECT_EQ(plain[3].value, law.factors(position)[3].value);
  EXPECT_EQ(plain[6].value, 1.0);
}

TEST(CoatedLaw, AnswersWithoutAllocation)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kBody,
    { .mode = LawMode::Corrected, .coatings = one(2.0_mm, { 60.0_kPa, 0.4 }) });
  const test::AllocationGuard guard;
  const ForceLaw copy = law;
  EXPECT_GT(copy({ .depth = 2.0_mm, .thickness = 30.0_mm }).force, 0.0);
  EXPECT_EQ(guard.count(), 0U);
}

// thinner than its coatings and a fifth of the tool it is answered as if it were not
TEST(CoatedLaw, IsNotBelievedOnABodyTooThinForIt)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kBody,
    { .mode = LawMode::Corrected, .coatings = one(5.0_mm, { 20.0_kPa, 0.4 }) });
  const Validity validity(law);
  const auto believed = [&](double thickness)
  {
    const Rules rules = validity({ .depth = 0.1_mm, .thickness = thickness });
    return std::ranges::all_of(rules,
      [](const Rule& rule) { return std::string_view(rule.name) != "thickness" || rule.holds(); });
  };
  EXPECT_TRUE(believed(kInfinite) && believed(7.1_mm));
  EXPECT_FALSE(believed(6.9_mm) || believed(4.0_mm));
}

// a graded stack stretches as the one sheet that it stands for
TEST(CoatedLaw, IsNotBelievedWhereItsSkinStretches)
{
  const auto believed = [](const Coatings& coatings, double depth)
  {
    const Validity validity(ForceLaw(SphereTip{ 10.0_mm }, { 2.0_kPa, 0.38 },
      { .mode = LawMode::Corrected, .coatings = coatings }));
    const Rules rules = validity({ .depth = depth });
    return std::ranges::find(rules, std::string("large_strain"), &Rule::name)->holds();
  };
  Coatings graded = one(1.0_mm, { 30.0_kPa, 0.45 });
  graded.add({ 1.0_mm, { 9.0_kPa, 0.45 } });
  EXPECT_TRUE(believed(one(1.0_mm, { 30.0_kPa, 0.45 }), 0.99_mm));
  EXPECT_FALSE(believed(one(1.0_mm, { 30.0_kPa, 0.45 }), 1.01_mm));
  EXPECT_TRUE(believed(graded, 1.99_mm));
  EXPECT_FALSE(believed(graded, 2.01_mm));
  EXPECT_TRUE(believed(one(1.0_mm, { 8.0_kPa, 0.45 }), 3.0_mm));
}

TEST(Coatings, RefuseWhatCannotBeComputed)
{
  Coatings coatings;
  EXPECT_THROW(coatings.add({ 0.0, kBody }), Error);
  EXPECT_THROW(coatings.add({ std::nan(""), kBody }), Error);
  EXPECT_THROW(coatings.add({ 1.0_mm, { 1.0_kPa, 0.6 } }), Error);
  for (std::size_t i = 0; i < Coatings::kMost; ++i)
  {
    coatings.add({ 1.0_mm, kBody });
  }
  EXPECT_THROW(coatings.add({ 1.0_mm, kBody }), Error);
  EXPECT_NEAR(coatings.thickness(), 4.0_mm, 1e-12);
  // hide over water, and a sheet of paper under a fist
  EXPECT_THROW(
    (void)coatedContact(SphereTip{ 10.0_mm }, one(1.0_mm, { 300.0_kPa, 0.4 }), kBody), Error);
  // nor by steps
  Coatings steps = one(1.0_mm, { 300.0_kPa, 0.4 });
  steps.add({ 1.0_mm, { 60.0_kPa, 0.4 } });
  EXPECT_THROW((void)coatedContact(SphereTip{ 10.0_mm }, steps, kBody), Error);
  EXPECT_THROW((void)coatedContact(SphereTip{ 50.0_mm }, one(0.2_mm, kBody), kBody), Error);
}

} // namespace
} // namespace palp
