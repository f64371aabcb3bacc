#include "haptics/force/nodules/detection.h"

#include "haptics/error.h"
#include "tests/haptics/force/nodules/nodule_cases.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kHalfSpace = std::numeric_limits<double>::infinity();
constexpr JustNoticeable kForce = kJustNoticeable[0];
constexpr JustNoticeable kFinger = kJustNoticeable[1];
constexpr JustNoticeable kCompliance = kJustNoticeable[2];
constexpr JustNoticeable kStylus = kJustNoticeable[3];

const Tip kCone = BluntConeTip{ 45.0_deg, 0.3_mm, 50.0_mm };

NoduleContrast contrastOf(const Tip& tip, double nu, double thickness, double depth)
{
  const test::NoduleCase one{ tip, nu, thickness, depth };
  return { one.law(), { .depth = depth, .thickness = thickness } };
}

// 0 for none
std::vector<double> diametersMm(const NoduleContrast& contrast, double cover, double ratio,
  std::initializer_list<JustNoticeable> noticed)
{
  std::vector<double> diameters;
  for (const auto& one : smallestDetectable(contrast, cover, ratio, noticed))
  {
    diameters.push_back(one ? units::toMillimeters(2.0 * one->nodule.radius) : 0.0);
  }
  return diameters;
}

// found by halving the radius in the independent program of the nodules' theory, with force, radius
// and stiffness of the homogeneous body by finite elements (thickness 40 mm) or Sneddon
TEST(Detection, DiametersAreThoseOfTheOracle)
{
  struct Case
  {
    Tip tip;
    double nu;
    double thickness; // [m]
    double depth;     // [m]
    double cover;     // [m]
    double ratio;
    std::array<double, 4> diameters; // at 7, 15, 22 and 45 % of force [mm]; 0: none, or too large
  };
  const Case cases[]{ { SphereTip{ 10.0_mm }, 0.45, 40.0_mm, 4.0_mm, 5.0_mm, 5.0,
                        { 7.593, 10.916, 13.427, 21.376 } },
    { SphereTip{ 10.0_mm }, 0.45, 40.0_mm, 8.0_mm, 2.0_mm, 7.7, { 7.678, 9.972, 11.509, 15.549 } },
    { kCone, 0.45, 40.0_mm, 6.0_mm, 3.0_mm, 20.0, { 4.091, 5.743, 6.929, 10.326 } },
    { PunchTip{ 4.0_mm }, 0.45, 40.0_mm, 1.0_mm, 5.0_mm, 0.2, { 7.970, 12.713, 17.227, 0.0 } },
    { SphereTip{ 10.0_mm }, 0.45, 40.0_mm, 2.0_mm, 8.0_mm, 50.0,
      { 8.486, 12.855, 16.406, 29.851 } },
    { kCone, 0.45, 40.0_mm, 8.0_mm, 5.0_mm, 0.2, { 7.558, 11.592, 15.141, 32.474 } },
    { SphereTip{ 6.0_mm }, 0.33, kHalfSpace, 4.0_mm, 4.0_mm, 7.7,
      { 6.125, 9.170, 11.657, 20.885 } },
    { SphereTip{ 10.0_mm }, 0.49, kHalfSpace, 5.0_mm, 6.0_mm, 10.0,
      { 8.278, 11.997, 14.833, 23.893 } },
    { PunchTip{ 5.0_mm }, 0.45, kHalfSpace, 1.0_mm, 5.0_mm, 3.0, { 9.996, 15.768, 21.095, 0.0 } } };
  double worst = 0.0;
  for (const Case& one : cases)
  {
    const NoduleContrast contrast = contrastOf(one.tip, one.nu, one.thickness, one.depth);
    const auto found = diametersMm(
      contrast, one.cover, one.ratio, { kForce, kFinger, { "force", 0.22, "none" }, kStylus });
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      EXPECT_NEAR(found[i], one.diameters[i], 0.015 * one.diameters[i]) << i;
      worst = one.diameters[i] > 0.0 ? std::max(worst, std::abs(found[i] / one.diameters[i] - 1.0))
                                     : worst;
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

// the same program, of half-spaces, by the depth that a newton takes: beside less above
TEST(Detection, ComplianceIsThatOfTheOracle)
{
  struct Case
  {
    Tip tip;
    double nu;
    double depth; // [m]
    double cover; // [m]
    double ratio;
    double diameter; // [mm]
  };
  for (const Case& one : { Case{ SphereTip{ 6.0_mm }, 0.33, 4.0_mm, 4.0_mm, 7.7, 13.916 },
         { SphereTip{ 10.0_mm }, 0.49, 5.0_mm, 6.0_mm, 10.0, 17.254 },
         { PunchTip{ 5.0_mm }, 0.45, 1.0_mm, 5.0_mm, 3.0, 26.454 },
         { SphereTip{ 10.0_mm }, 0.45, 4.0_mm, 5.0_mm, 0.2, 15.586 },
         { PunchTip{ 5.0_mm }, 0.45, 1.0_mm, 3.0_mm, 0.2, 12.450 },
         { SphereTip{ 8.0_mm }, 0.33, 3.0_mm, 2.0_mm, 0.4, 11.572 } })
  {
    const NoduleContrast contrast = contrastOf(one.tip, one.nu, kHalfSpace, one.depth);
    EXPECT_NEAR(diametersMm(contrast, one.cover, one.ratio, { kCompliance })[0], one.diameter,
      0.015 * one.diameter);
  }
}

// A table of the same energy without images of surface and tool, in steps of half a millimeter, for
// the flat punch of 1 to 10 mm that feels best; nu 0.45, half-space.
TEST(Detection, BestPunchFeelsWhatTheSimplerLawTells)
{
  struct Row
  {
    double ratio;
    JustNoticeable noticed;
    std::array<double, 4> diameters; // below 2, 5, 10 and 20 mm [mm]; 0: none
  };
  const double covers[]{ 2.0_mm, 5.0_mm, 10.0_mm, 20.0_mm };
  for (const Row& row :
    { Row{ 7.7, kForce, { 3.0, 7.5, 14.5, 29.0 } }, { 7.7, kFinger, { 5.0, 11.5, 22.5, 47.5 } },
      { 50.0, kForce, { 2.5, 6.5, 12.5, 24.5 } }, { 3.0, kFinger, { 6.5, 16.0, 31.5, 0.0 } } })
  {
    for (std::size_t i = 0; i < std::size(covers) && row.diameters[i] > 0.0; ++i)
    {
      double best = std::numeric_limits<double>::infinity();
      for (int a = 1; a <= 10; ++a)
      {
        const NoduleContrast contrast =
          contrastOf(PunchTip{ a * 1.0_mm }, 0.45, kHalfSpace, 1.0_mm);
        const double found = diametersMm(contrast, covers[i], row.ratio, { row.noticed })[0];
        best = found > 0.0 ? std::min(best, found) : best;
      }
      EXPECT_NEAR(best, row.diameters[i], 0.5 + 0.02 * row.diameters[i])
        << row.ratio << " times, " << row.noticed.name << ", cover " << covers[i];
    }
  }
}

// Gerling et al. 2010: of 18 people more than three quarters found hard balls of 4 mm about a depth
// of 5 mm, and no smaller ones. By first order 20/pi a b^3 z^4 / (a^2 + z^2)^4, most at a = 0.38 z.
TEST(Detection, AHardBallOf4mmIsTheSmallestThatPeopleFind)
{
  const double depth = 5.0_mm;
  const NoduleContrast contrast = contrastOf(PunchTip{ 0.38 * depth }, 0.49, kHalfSpace, 1.0_mm);
  EXPECT_NEAR(contrast({ 2.0_mm, depth - 2.0_mm, 50.0 }), 1.41 * std::pow(0.4, 3.0), 0.005);
  const double smallest = diametersMm(contrast, depth - 2.0_mm, 50.0, { kForce })[0];
  EXPECT_LT(smallest, 4.0);
  EXPECT_GT(smallest, 3.5);
}

TEST(Detection, ContrastIsThatOfTheForce)
{
  for (const double thickness : { kHalfSpace, 40.0_mm })
  {
    for (const double ratio : { 0.2, 7.7, 50.0 })
    {
      const test::NoduleCase one{ SphereTip{ 10.0_mm }, 0.45, thickness, 5.0_mm };
      const Nodule nodule{ 5.0_mm, 4.0_mm, ratio };
      const double added =
        Nodules(one.press(), std::span(&nodule, 1))(one.deepest, std::array{ 0.0 }).response.force;
      const double plain = one.law()({ .depth = one.deepest, .thickness = thickness }).force;
      EXPECT_NEAR(contrastOf(one.tip, 0.45, thickness, one.deepest)(nodule), added / plain,
        1e-3 * std::abs(added / plain))
        << thickness << ' ' << ratio;
    }
  }
}

// so that there is one smallest nodule: tools, tissues, depths, covers and stiffnesses of all kinds
TEST(Detection, ALargerNoduleIsFeltBetter)
{
  int compared = 0;
  for (const Tip& tip :
    { Tip(SphereTip{ 3.0_mm }), Tip(SphereTip{ 10.0_mm }), Tip(PunchTip{ 4.0_mm }), kCone })
  {
    for (const auto& [nu, thickness] :
      { std::pair(0.33, kHalfSpace), { 0.45, 30.0_mm }, { 0.49, 60.0_mm } })
    {
      for (const double depth : { 1.0_mm, 5.0_mm, 10.0_mm })
      {
        const NoduleContrast contrast = contrastOf(tip, nu, thickness, depth);
        for (const double cover : { 1.0_mm, 3.0_mm, 10.0_mm })
        {
          const double largest =
            std::min(0.5 * (thickness - cover), cover * kClosestNodule / (1.0 - kClosestNodule));
          for (const double ratio : { 0.2, 0.7, 3.0, 50.0 })
          {
            double before = 0.0;
            for (double radius = 0.1_mm; radius <= largest; radius *= 1.3)
            {
              const double now = contrast({ radius, cover, ratio });
              EXPECT_EQ(now > 0.0, ratio > 1.0);
              EXPECT_GT(std::abs(now), before) << nu << ' ' << thickness << ' ' << depth << ' '
                                               << cover << ' ' << ratio << ' ' << radius;
              before = std::abs(now);
              ++compared;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(compared, 4000);
}

TEST(Detection, WhatItFindsComesToTheDifferenceAndNoMore)
{
  const NoduleContrast contrast = contrastOf(SphereTip{ 10.0_mm }, 0.45, 40.0_mm, 5.0_mm);
  for (const double ratio : { 0.2, 0.5, 3.0, 50.0 })
  {
    const std::array differences{ 0.05, 0.2 };
    const std::array noticed{ JustNoticeable{ "force", differences[0], "none" },
      JustNoticeable{ "force", differences[1], "none" } };
    const auto found = smallestDetectable(contrast, 4.0_mm, ratio, noticed);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      ASSERT_TRUE(found[i]) << ratio;
      EXPECT_NEAR(std::abs(found[i]->contrast), differences[i], 1e-4) << ratio;
      EXPECT_EQ(found[i]->contrast > 0.0, ratio > 1.0);
    }
  }
}

TEST(Detection, TellsNoneAndRefusesWhatFitsNowhere)
{
  const NoduleContrast contrast = contrastOf(SphereTip{ 10.0_mm }, 0.45, 40.0_mm, 5.0_mm);
  EXPECT_EQ(diametersMm(contrast, 30.0_mm, 1.5, { kForce })[0], 0.0);
  EXPECT_THROW((void)diametersMm(contrast, 40.0_mm, 7.7, { kForce }), Error);
  EXPECT_THROW((void)diametersMm(contrast, 5.0_mm, 0.0, { kForce }), Error);
  EXPECT_THROW((void)diametersMm(contrast, 5.0_mm, 51.0, { kForce }), Error);
}

TEST(Detection, FlagsANoduleThatNearlyReachesTheSurface)
{
  const NoduleContrast contrast = contrastOf(PunchTip{ 4.0_mm }, 0.45, kHalfSpace, 1.0_mm);
  EXPECT_TRUE(contrast.rules({ 10.0_mm, 5.0_mm, 7.7 })[0].holds());
  EXPECT_FALSE(contrast.rules({ 16.0_mm, 5.0_mm, 7.7 })[0].holds()); // b over depth 0.76
}

} // namespace
} // namespace palp
