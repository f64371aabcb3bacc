#include "haptics/contact/contact_geometry_of.h"
#include "haptics/contact/find_contact.h"
#include "haptics/force/validity.h"
#include "haptics/units.h"
#include "tests/support/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string_view>

namespace palp
{
namespace
{

using namespace units::literals;

const Material kLiver{ .youngModulus = 50.0_kPa, .poissonRatio = 0.33 };

bool seesEdge(const Validity& validity, const Contact& contact)
{
  const Rules rules = validity(contactGeometryOf(contact), contact.edgeDistance);
  const auto edge = std::ranges::find_if(
    rules, [](const Rule& rule) { return std::string_view(rule.name) == "edge"; });
  return edge != rules.end() && !edge->holds();
}

// beside the edge of a block the force falls short of that in its middle, by linear finite elements
// in three dimensions; 7 % is noticed
TEST(EdgeRule, SeesTheEdgeOfAClosedBodyWhereverTheForceErrsBy7Percent)
{
  struct Row
  {
    double distance;
    double depth;
    double overCenter;
  };
  constexpr std::array rows{ Row{ 20.0_mm, 1.0_mm, 0.98 }, Row{ 20.0_mm, 2.0_mm, 0.97 },
    Row{ 20.0_mm, 4.0_mm, 0.95 }, Row{ 8.0_mm, 1.0_mm, 0.87 }, Row{ 8.0_mm, 2.0_mm, 0.83 },
    Row{ 8.0_mm, 4.0_mm, 0.78 }, Row{ 4.0_mm, 1.0_mm, 0.73 }, Row{ 4.0_mm, 2.0_mm, 0.68 },
    Row{ 4.0_mm, 4.0_mm, 0.63 } };
  const SphereTip tip{ 10.0_mm };
  const ForceLaw law(tip, kLiver, { .mode = LawMode::Corrected });
  const Validity validity(law);
  for (const int n : { 1, 6, 40 })
  {
    const Surface block = test::makeSurface(test::block({ 0.1, 0.1, 0.05 }, n));
    for (const ContactRule contactRule : { ContactRule::Exact, ContactRule::Paper })
    {
      for (const Row& row : rows)
      {
        const Contact contact = findContact(
          block, tip, { .apex = { 50.0_mm - row.distance, 1.0_mm, -row.depth } }, contactRule);
        if (contact.touching() && row.overCenter < 0.93)
        {
          EXPECT_TRUE(seesEdge(validity, contact)) << n << ": " << row.distance << " " << row.depth;
        }
      }
    }
    const Contact middle =
      findContact(block, tip, { .apex = { 1.0_mm, 2.0_mm, -4.0_mm } }, ContactRule::Exact);
    EXPECT_FALSE(seesEdge(validity, middle)) << n;
  }
}

// a small contact beside an edge lies within one triangle of a coarse mesh
TEST(EdgeRule, SeesTheEdgeFromFiveContactRadiiOnHoweverCoarseTheMesh)
{
  for (const int n : { 1, 2, 6, 20 })
  {
    const Surface block = test::makeSurface(test::block({ 60.0_mm, 60.0_mm, 30.0_mm }, n));
    for (const Tip& tip : { Tip(ConeTip{ 45.0_deg, 10.0_mm }), Tip(ConeTip{ 60.0_deg, 10.0_mm }),
           Tip(SphereTip{ 2.0_mm }), Tip(SphereTip{ 10.0_mm }) })
    {
      const ForceLaw law(tip, kLiver, { .mode = LawMode::Corrected });
      const Validity validity(law);
      for (const double depth : { 0.1_mm, 0.3_mm, 1.0_mm })
      {
        const double reach = law({ .depth = depth }).contactRadius;
        for (const double radii : { 0.5, 1.0, 2.0, 3.0, 4.5 })
        {
          if (radii * reach <= depth || radii * reach > 25.0_mm)
          {
            continue; // the wall is nearer than the top, or another edge
          }
          const Contact contact = findContact(block, tip,
            { .apex = { 30.0_mm - radii * reach, 3.0_mm, -depth } }, ContactRule::Exact);
          EXPECT_TRUE(seesEdge(validity, contact)) << n << ": " << radii << " radii, " << depth;
        }
      }
    }
  }
}

// two faces that meet below the edges that are told by their distance; a ball bends evenly
TEST(EdgeRule, SeesABendBelowTheToolAndNoneOnABall)
{
  const SphereTip tip{ 10.0_mm };
  const Validity validity(ForceLaw(tip, kLiver, { .mode = LawMode::Corrected }));
  const auto bent = [](double turn)
  {
    return test::makeSurface(test::sheet(
      0.12, 121, [&](double x, double) { return -std::abs(x) * std::tan(0.5 * turn); }));
  };
  const auto sees = [&](const Surface& surface, double x, double z)
  {
    return seesEdge(
      validity, findContact(surface, tip, { .apex = { x, 0.3_mm, z } }, ContactRule::Exact));
  };
  EXPECT_TRUE(sees(bent(50.0_deg), 0.0, -2.0_mm));
  EXPECT_FALSE(sees(bent(10.0_deg), 0.0, -2.0_mm));
  EXPECT_FALSE(sees(bent(50.0_deg), 35.0_mm, -35.0_mm * std::tan(25.0_deg) - 1.0_mm));
  const Surface ball = test::makeSurface(test::ball(30.0_mm, 60));
  for (double depth = 0.25_mm; depth <= 8.0_mm; depth += 0.25_mm)
  {
    EXPECT_FALSE(sees(ball, 0.2_mm, 30.0_mm - depth)) << depth;
  }
}

} // namespace
} // namespace palp
