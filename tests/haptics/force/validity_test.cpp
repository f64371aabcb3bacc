#include "haptics/force/validity.h"

#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/tip/profile.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

const Material kOrgan{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };

const Rule& rule(const Rules& rules, const char* name)
{
  for (const Rule& one : rules)
  {
    if (std::strcmp(one.name, name) == 0)
    {
      return one;
    }
  }
  throw std::runtime_error(name);
}

// Eq. (7): 21.6 degrees for a sphere; Sec. 3.2: 9 degrees for a cone, 32 for the direction
TEST(Validity, LimitsTheTiltAsThePaperDoes)
{
  const Validity sphere(ForceLaw(SphereTip{ 10.0_mm }, kOrgan));
  const Validity cone(ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, kOrgan));
  const auto at = [](double tilt) { return ContactGeometry{ .depth = 1.0_mm, .tilt = tilt }; };
  EXPECT_TRUE(rule(sphere(at(21.5_deg)), "inclination").holds());
  EXPECT_FALSE(rule(sphere(at(21.6_deg)), "inclination").holds());
  EXPECT_TRUE(rule(cone(at(8.9_deg)), "inclination").holds());
  EXPECT_FALSE(rule(cone(at(-9.1_deg)), "inclination").holds());
  EXPECT_TRUE(rule(cone(at(31.0_deg)), "direction").holds());
  EXPECT_FALSE(rule(cone(at(33.0_deg)), "direction").holds());
}

TEST(Validity, CorrectedConeMayTiltAsFarAsTheBoundaryElements)
{
  const Validity cone(
    ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, kOrgan, { .mode = LawMode::Corrected }));
  EXPECT_TRUE(rule(cone({ .depth = 1.0_mm, .tilt = 29.0_deg }), "inclination").holds());
  EXPECT_FALSE(rule(cone({ .depth = 1.0_mm, .tilt = 31.0_deg }), "inclination").holds());
}

// where its factor acts, and there only, the normals below the tool count
TEST(Validity, CorrectedConeMayNotTiltOverAnEdge)
{
  const auto inclination = [](const Tip& tip, const LawSettings& settings, double spread)
  {
    const Validity validity(ForceLaw(tip, kOrgan, settings));
    return rule(
      validity({ .depth = 1.0_mm, .tilt = 20.0_deg, .normalSpread = spread }), "inclination");
  };
  const ConeTip cone{ 45.0_deg, 10.0_mm };
  const LawSettings corrected{ .mode = LawMode::Corrected };
  EXPECT_TRUE(inclination(cone, corrected, 4.9_deg).holds());
  EXPECT_FALSE(inclination(cone, corrected, 5.1_deg).holds());
  EXPECT_NE(std::string(inclination(cone, corrected, 0.0).why).find("edge"), std::string::npos);
  EXPECT_EQ(inclination(SphereTip{ 10.0_mm }, corrected, 1.0).value, 20.0_deg); // whose factor is 1
  EXPECT_EQ(inclination(cone, { .mode = LawMode::Exact }, 1.0).value, 20.0_deg);
  EXPECT_EQ(
    inclination(cone, { .mode = LawMode::Corrected, .inclination = false }, 1.0).value, 20.0_deg);
}

// Slides of 0.02 mm a step over the rim of a lens 16 mm thick, where the normal turns by up to
// 5 degrees a step; its top is told to be fine.
TEST(Validity, SeesWhereTheFactorOfInclinationTurnsFast)
{
  test::Mesh mesh = test::ball(1.0, 40);
  for (Eigen::Vector3d& point : mesh.first)
  {
    point = point.cwiseProduct(Eigen::Vector3d(40.0_mm, 30.0_mm, 8.0_mm));
  }
  const Surface lens = test::makeSurface(std::move(mesh));
  const ForceLaw law(ConeTip{ 45.0_deg, 10.0_mm }, kOrgan, { .mode = LawMode::Corrected });
  const Validity validity(law);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const auto direction = [&] { return Eigen::Vector3d(part(random), part(random), part(random)); };
  double fastest = 0.0; // of what holds, by a step
  double worst = 0.0;   // of what does not
  int fine = 0;
  for (int i = 0; i < 200; ++i)
  {
    const double height = i % 4 == 0 ? 1.0 : 0.6 * part(random); // the top, else about the rim
    const double turn = std::numbers::pi * part(random);
    const double around = std::sqrt(1.0 - height * height);
    const Eigen::Vector3d on(
      40.0_mm * around * std::cos(turn), 30.0_mm * around * std::sin(turn), 8.0_mm * height);
    const Eigen::Vector3d out = on.cwiseQuotient(Eigen::Vector3d(1600.0, 900.0, 64.0)).normalized();
    ToolPose pose{ .apex = on - 2.0_mm * out, .axis = (-out + 0.2 * direction()).normalized() };
    const Eigen::Vector3d along = 0.02_mm * out.cross(direction()).normalized();
    double last = 0.0;
    for (int k = 0; k < 150; ++k)
    {
      pose.apex += along;
      const Contact contact = findContact(lens, law.tip(), pose, ContactRule::Exact);
      const ContactGeometry place = contactGeometryOf(contact);
      const double factor = contact.touching() ? law.factors(place)[5].value : 0.0;
      const double change = last > 0.0 && factor > 0.0 ? std::abs(factor / last - 1.0) : 0.0;
      const bool holds = rule(validity(place), "inclination").holds();
      (holds ? fastest : worst) = std::max(holds ? fastest : worst, change);
      fine += holds && i % 4 == 0 ? 1 : 0;
      last = factor;
    }
  }
  EXPECT_LE(fastest, 0.005);
  EXPECT_GE(worst, 3.0 * 0.005); // or it turned nowhere fast
  EXPECT_GE(fine, 50 * 150 * 9 / 10);
}

// Eq. (4) is above the exact sphere by 11 % at depth = R and by 5.3 % at R / 2
TEST(Validity, TellsWhenTheForceIsNoticeablyOff)
{
  const Validity paper(ForceLaw(SphereTip{ 10.0_mm }, kOrgan));
  EXPECT_NEAR(rule(paper({ .depth = 10.0_mm }), "force_of_itself").value, 0.11, 0.005);
  EXPECT_FALSE(rule(paper({ .depth = 10.0_mm }), "force_of_itself").holds());
  EXPECT_TRUE(rule(paper({ .depth = 5.0_mm }), "force_of_itself").holds());
  // of the maximum, at the radius, it is less than of itself
  const Rules half = paper({ .depth = 5.0_mm });
  EXPECT_LT(rule(half, "force_of_maximum").value, rule(half, "force_of_itself").value);
}

TEST(Validity, ChangesWithTheMaximumOfTheExperiment)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kOrgan);
  const Validity shallow(law, { .deepest = 4.0_mm });
  const Validity deep(law, { .deepest = 8.0_mm });
  const ContactGeometry position{ .depth = 4.0_mm };
  EXPECT_NEAR(rule(shallow(position), "force_of_maximum").value,
    rule(shallow(position), "force_of_itself").value, 1e-12);
  EXPECT_LT(rule(deep(position), "force_of_maximum").value,
    rule(shallow(position), "force_of_maximum").value);
}

// the first order of the layer, (2/pi) m0 a/h, is 7 % at a/h = 0.07 pi / (2 * 1.41177)
TEST(Validity, LimitsTheContactOnAThinBody)
{
  const Validity paper(ForceLaw(SphereTip{ 10.0_mm }, kOrgan));
  EXPECT_NEAR(rule(paper({ .depth = 1.0_mm }), "thickness").limit, 0.07789, 2e-5);
  EXPECT_FALSE(rule(paper({ .depth = 1.0_mm, .thickness = 30.0_mm }), "thickness").holds());
  const Validity corrected(ForceLaw(SphereTip{ 10.0_mm }, kOrgan, { .mode = LawMode::Corrected }));
  EXPECT_TRUE(rule(corrected({ .depth = 1.0_mm, .thickness = 30.0_mm }), "thickness").holds());
  EXPECT_FALSE(rule(corrected({ .depth = 5.0_mm, .thickness = 10.0_mm }), "thickness").holds());
}

// a flat tip on a ball is as a tip with the ball's gap on a plane, once all of it touches
TEST(Validity, SeesWhatAFlatTipLacksOnACurvedSurface)
{
  constexpr double kRadius = 5.0_mm;
  for (const double ball : { 40.0_mm, 100.0_mm, 300.0_mm })
  {
    std::vector<Profile::Point> points;
    for (int i = 0; i <= 200; ++i)
    {
      const double r = kRadius * i / 200;
      points.push_back({ r, 0.5 * r * r / ball });
    }
    const LawSettings exact{ .mode = LawMode::Exact };
    const ForceLaw rounded(
      ProfileTip{ std::make_shared<const Profile>(std::move(points)) }, kOrgan, exact);
    const ForceLaw flat(PunchTip{ kRadius }, kOrgan, exact);
    const Validity validity(flat);
    for (const double depth : { 1.0_mm, 3.0_mm })
    {
      const double lack = 1.0 - rounded({ .depth = depth }).force / flat({ .depth = depth }).force;
      for (const double side : { 1.0, -1.0 }) // a hollow meets the rim first
      {
        const Rules rules = validity({ .depth = depth, .surfaceCurvature = side / ball });
        EXPECT_NEAR(rule(rules, "curvature").value, lack, 0.01 * lack) << ball << " " << depth;
        EXPECT_EQ(rule(rules, "curvature").holds(), lack < 0.05) << ball << " " << depth;
      }
    }
  }
}

TEST(Validity, LimitsDepthCurvatureEdgeAndStiffness)
{
  const Validity paper(ForceLaw(SphereTip{ 6.0_mm }, kOrgan), { .stableStiffness = 500.0 });
  EXPECT_TRUE(rule(paper({ .depth = 3.2_mm }), "depth").holds());
  EXPECT_FALSE(rule(paper({ .depth = 3.4_mm }), "depth").holds());
  const ContactGeometry flat{ .depth = 0.1_mm, .surfaceCurvature = 1.0 / 19.0_mm };
  EXPECT_TRUE(rule(paper(flat), "curvature").holds());
  const ContactGeometry bent{ .depth = 0.1_mm, .surfaceCurvature = -1.0 / 17.0_mm };
  EXPECT_FALSE(rule(paper(bent), "curvature").holds());
  EXPECT_TRUE(rule(paper({ .depth = 1.5_mm }, 15.1_mm), "edge").holds());
  EXPECT_FALSE(rule(paper({ .depth = 1.5_mm }, 14.9_mm), "edge").holds());
  // dF/ddepth = 2 E* sqrt(R depth): 500 N/m at 3.3 mm
  EXPECT_TRUE(rule(paper({ .depth = 3.2_mm }), "stiffness").holds());
  EXPECT_FALSE(rule(paper({ .depth = 3.4_mm }), "stiffness").holds());
}

TEST(Validity, CountsBrokenRulesAsBits)
{
  const Validity paper(ForceLaw(SphereTip{ 6.0_mm }, kOrgan));
  EXPECT_EQ(brokenRules(paper({ .depth = 0.1_mm })), 0U);
  EXPECT_EQ(brokenRules(paper({ .depth = 0.1_mm, .tilt = 25.0_deg })), 4U);
  EXPECT_EQ(brokenRules(paper({ .depth = 0.1_mm, .tilt = 33.0_deg })), 4U + 8U);
}

TEST(Validity, TellsThatLargeStrainIsNotCovered)
{
  const ForceLaw bare(SphereTip{ 10.0_mm }, kOrgan, { .mode = LawMode::Corrected });
  EXPECT_FALSE(rule(Validity(bare)({ .depth = 5.0_mm }), "large_strain").holds());
  const auto table = std::make_shared<const LargeStrain>(
    LargeStrain{ { { 0.0, 1.0 }, { 0.0 }, { 0.33 }, { 1.0, 1.1 } },
      { { 0.0, 1.0 }, { 0.5 }, { 0.33 }, { 1.0, 1.0 } } });
  const ForceLaw full(
    SphereTip{ 10.0_mm }, kOrgan, { .mode = LawMode::Corrected, .largeStrain = table });
  EXPECT_TRUE(rule(Validity(full)({ .depth = 5.0_mm }), "large_strain").holds());
}

// what neo-Hookean elements give over the linear law, at any depth: 30 degrees -3 % (nu 0.33), 12 %
// (0.45) and 17 % (0.49); 45 degrees 4 % (0.49) and -17 to -20 % (0), 60 degrees -13 to -16 % (0)
TEST(Validity, SeesTheStrainUnderAConeAtAnyDepth)
{
  const auto holds = [](double halfAngle, double nu, double depth)
  {
    const ForceLaw law(
      ConeTip{ halfAngle, 20.0_mm }, { 50.0_kPa, nu }, { .mode = LawMode::Corrected });
    return rule(Validity(law)({ .depth = depth }), "large_strain").holds();
  };
  for (const double depth : { 0.01_mm, 1.0_mm, 5.0_mm })
  {
    EXPECT_FALSE(holds(30.0_deg, 0.45, depth));
    EXPECT_FALSE(holds(30.0_deg, 0.49, depth));
    EXPECT_FALSE(holds(45.0_deg, 0.0, depth));
    EXPECT_FALSE(holds(60.0_deg, 0.0, depth));
    EXPECT_FALSE(holds(15.0_deg, 0.33, depth));
    EXPECT_TRUE(holds(60.0_deg, 0.4, depth));
  }
}

// boundary elements: 60 degrees -3 % at 20 and -25 % at 25; 30 degrees 2 % at 25
TEST(Validity, LimitsTheTiltOfAConeByItsHalfAngle)
{
  const auto holds = [](double halfAngle, double tilt)
  {
    const ForceLaw law(ConeTip{ halfAngle, 10.0_mm }, kOrgan, { .mode = LawMode::Corrected });
    return rule(Validity(law)({ .depth = 1.0_mm, .tilt = tilt }), "inclination").holds();
  };
  EXPECT_TRUE(holds(60.0_deg, 14.9_deg));
  EXPECT_FALSE(holds(60.0_deg, 15.1_deg));
  EXPECT_TRUE(holds(30.0_deg, 24.9_deg));
  EXPECT_FALSE(holds(30.0_deg, 25.1_deg));
  for (double angle = 61.0_deg; angle < 89.0_deg; angle += 1.0_deg)
  {
    EXPECT_FALSE(holds(angle, 90.0_deg - angle)); // the flank lies along the surface
  }
}

TEST(Validity, SeesADepthBeyondHalfTheBody)
{
  for (const Tip& tip : { Tip{ ConeTip{ 5.0_deg, 10.0_mm } }, Tip{ SphereTip{ 10.0_mm } } })
  {
    for (const LawMode mode : { LawMode::Paper, LawMode::Exact, LawMode::Corrected })
    {
      const Validity validity(ForceLaw(tip, kOrgan, { .mode = mode }));
      const auto fraction = [&](double depth)
      { return rule(validity({ .depth = depth, .thickness = 8.0_mm }), "penetration").fraction(); };
      EXPECT_LT(fraction(3.9_mm), 1.0);
      EXPECT_GT(fraction(4.1_mm), 1.0);
      EXPECT_GT(fraction(10.0_mm), 2.0);
    }
  }
}

// the factor of an ellipse stays from 4 : 1 on, which is told
TEST(Validity, SeesAnEllipseThatIsTooSlender)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, kOrgan, { .mode = LawMode::Corrected });
  const auto position = [](double spread)
  { return ContactGeometry{ .depth = 1.0_mm, .curvatureSpread = spread }; };
  EXPECT_TRUE(rule(Validity(law)(position(59.0)), "ellipse").holds());
  EXPECT_FALSE(rule(Validity(law)(position(61.0)), "ellipse").holds());
  EXPECT_LT(law(position(1e6)).force, 1.17 * law(position(0.0)).force);
}

TEST(Validity, EveryRuleHasWordsAndNoNaN)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Validity validity(ForceLaw(PunchTip{ 5.0_mm }, kOrgan));
  for (const ContactGeometry& position :
    { ContactGeometry{}, ContactGeometry{ .depth = nan, .tilt = nan },
      ContactGeometry{ .depth = 1.0_mm, .thickness = nan, .surfaceCurvature = nan } })
  {
    for (const Rule& one : validity(position, nan))
    {
      EXPECT_FALSE(std::isnan(one.value)) << one.name;
      EXPECT_FALSE(std::isnan(one.limit)) << one.name;
      EXPECT_GE(one.value, 0.0) << one.name;
      EXPECT_GT(std::strlen(one.why), 10U) << one.name;
    }
  }
}

} // namespace
} // namespace palp
