#include "haptics/force/series/series_law.h"

#include "haptics/force/linear/half_space.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/csv_table.h"
#include "tests/support/series_press.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;
using test::SeriesPress;

constexpr double kPoisson = 0.45;

const BodyCompliance kBodies[] = { {}, { .constant = 30.0 }, { .constant = 800.0, .slope = 9e3 },
  { .constant = -12.0, .bend = 5e3 }, { .constant = 60.0, .slope = 4e3, .bend = -4e3 },
  { .constant = 150.0, .slope = 4.2e4, .edge = 500.0 },
  { .constant = 25.0, .slope = 2.6e3, .bend = 2e3, .edge = 125.0 } };

const Tip kTips[] = { SphereTip{ 10.0_mm }, ParaboloidTip{ 20.0_mm }, ConeTip{ 70.0_deg, 20.0_mm },
  PunchTip{ 5.0_mm }, BluntConeTip{ 60.0_deg, 2.0_mm, 15.0_mm } };

// The deepest that the force f over E* of a half-space's contact holds in a body, which is the
// derivative by f of the complementary energy, by halving, scanning and differences alone.
double depthInSeries(const Tip& tip, const BodyCompliance& body, double force)
{
  const HalfSpace contact(tip);
  const auto at = [&](double f)
  {
    double low = 0.0;
    double high = 0.1;
    for (int i = 0; i < 60; ++i)
    {
      const double middle = 0.5 * (low + high);
      (contact(middle).force < f ? low : high) = middle;
    }
    return std::pair(high, contact(high).radius);
  };
  const auto gain = [&](double f)
  {
    const double a = at(f).second;
    const auto* sphere = std::get_if<SphereTip>(&tip);
    const double q = sphere != nullptr ? sphere->radius * f : 4.0 / 3.0 * a * a * a;
    double most = 0.0;
    for (int i = 1; i <= 20000; ++i)
    {
      const double x = 0.5 * a * i / 20000;
      most = std::max(most, f * f * (body.slope * x / (1.0 + body.edge * x) - 0.5 * x * x / q));
    }
    return most;
  };
  const auto [local, a] = at(force);
  const double step = 1e-3 * force;
  return local + force * (body.constant + 4.0 / 15.0 * body.bend * a * a) -
    (gain(force + step) - gain(force - step)) / (2.0 * step);
}

TEST(SeriesLaw, ItsDepthIsTheSlopeOfItsComplementaryEnergy)
{
  for (const Tip& tip : kTips)
  {
    const SeriesPress press(tip);
    for (const BodyCompliance& body : kBodies)
    {
      for (const double depth : { 0.1_mm, 0.5_mm, 2.0_mm, 6.0_mm })
      {
        const SeriesResponse found = press(body, depth);
        const double force = found.felt.force / press.modulus();
        EXPECT_NEAR(depthInSeries(tip, body, force), depth, 1e-3 * depth)
          << tip.index() << ' ' << body.constant << ' ' << depth;
        EXPECT_FALSE(found.isBeyond);
      }
    }
  }
}

// a quarter of space, whose edge is so near that the ball presses over it: one compliance g / D,
// less what a block of 50 mm is stiffer by its base, at all depths and distances
TEST(SeriesLaw, BesideAnEdgeIsThatOfFiniteElements)
{
  constexpr double kWedge = 0.385; // E* G0 D
  constexpr double kBase = -26.0;  // [1/m]
  const SeriesPress press(SphereTip{ 10.0_mm });
  for (const int distance : { 2, 4, 6, 8 })
  {
    const double edge = 1000.0 / distance;
    const BodyCompliance body{
      .constant = kBase + kWedge * edge, .slope = 0.5 * kWedge * edge * edge, .edge = edge
    };
    const test::CsvTable table = test::readCsv(
      PALP_SOURCE_DIR "/data/reference/organ_edge90_" + std::to_string(distance) + "mm.csv");
    for (std::size_t i = 1; i < table["depth_m"].size(); ++i)
    {
      const double force = press.force(body, table["depth_m"][i]);
      EXPECT_NEAR(force, table["force_N"][i], 0.01 * force) << distance << ' ' << i;
    }
  }
}

// on the slope of a lobe the pressure goes to the stiffer side, and the force with it
TEST(SeriesLaw, GrowsWhereTheBodyIsSofterOnOneSide)
{
  for (const Tip& tip : kTips)
  {
    const SeriesPress press(tip);
    const double even = press({ .constant = 150.0 }, 4.0_mm).felt.force;
    const BodyCompliance sloping{ .constant = 150.0, .slope = 5000.0 };
    EXPECT_GT(press.force(sloping, 4.0_mm), even) << tip.index();
  }
}

TEST(SeriesLaw, OfAFlatPunchIsThatOfTwoSprings)
{
  const double a = 5.0_mm;
  const SeriesPress press(PunchTip{ a });
  const double modulus = press.modulus();
  for (const double constant : { -40.0, 3.0, 200.0, 5000.0 })
  {
    const SeriesResponse found = press({ .constant = constant }, 2.0_mm);
    const double stiffness = modulus / (1.0 / (2.0 * a) + constant);
    EXPECT_NEAR(found.felt.force, stiffness * 2.0_mm, 1e-6 * found.felt.force) << constant;
    EXPECT_NEAR(found.felt.stiffness, stiffness, 1e-6 * stiffness);
  }
}

// but for how the growth of a blunt cone's contact changes from cap to flank
TEST(SeriesLaw, ItsStiffnessIsTheSlopeOfItsForce)
{
  for (const Tip& tip : kTips)
  {
    const SeriesPress press(tip);
    const double part = std::holds_alternative<BluntConeTip>(tip) ? 1e-3 : 1e-4;
    for (const BodyCompliance& body : kBodies)
    {
      for (const double depth : { 0.5_mm, 3.0_mm, 7.0_mm })
      {
        constexpr double step = 1e-7;
        const double slope =
          (press.force(body, depth + step) - press.force(body, depth - step)) / (2.0 * step);
        EXPECT_NEAR(press(body, depth).felt.stiffness, slope, part * slope)
          << tip.index() << ' ' << body.constant << ' ' << depth;
      }
    }
  }
}

// U = F d - U*, whose derivative by the depth is the force
TEST(SeriesLaw, ItsEnergyIsTheWorkOfItsForce)
{
  for (const Tip& tip : kTips)
  {
    const SeriesPress press(tip);
    for (const BodyCompliance& body : kBodies)
    {
      constexpr int parts = 1000;
      constexpr double deepest = 6.0_mm;
      double work = 0.0;
      double local = 0.0; // of the contact alone
      for (int i = 0; i < parts; ++i)
      {
        const double depth = deepest * (i + 0.5) / parts;
        work += press.force(body, depth) * deepest / parts;
      }
      const SeriesResponse last = press(body, deepest);
      for (int i = 0; i < parts; ++i)
      {
        local += press.alone(last.local * (i + 0.5) / parts).force * last.local / parts;
      }
      const double complementary = last.felt.force * last.local - local +
        press.series().energy(body, press.series().load(body, last.felt.force));
      EXPECT_NEAR(last.felt.force * deepest - complementary, work, 1e-4 * work)
        << tip.index() << ' ' << body.constant;
    }
  }
}

// of a body that changes along the surface, at the same depth
TEST(SeriesLaw, ItsLateralForceIsTheSlopeOfTheEnergy)
{
  for (const Tip& tip : kTips)
  {
    const SeriesPress press(tip);
    const auto bodyAt = [](double s)
    {
      return BodyCompliance{ .constant = 60.0 + 3e3 * s,
        .slope = 3e3 + 2e5 * s,
        .bend = 2e3 + 4e5 * s,
        .edge = 130.0 + 2e4 * s };
    };
    for (const double deepest : { 1.0_mm, 4.0_mm, 7.0_mm })
    {
      const auto energy = [&](double s)
      {
        constexpr int parts = 1000;
        double work = 0.0;
        for (int i = 0; i < parts; ++i)
        {
          work += press.force(bodyAt(s), deepest * (i + 0.5) / parts) * deepest / parts;
        }
        return work;
      };
      constexpr double step = 0.1_mm;
      const double slope = (energy(step) - energy(-step)) / (2.0 * step);
      const double force = press.force(bodyAt(0.0), deepest);
      constexpr double aside = 1e-5; // [m]
      const Eigen::Vector3d lateral =
        press.series().lateral(bodyAt(0.0), { bodyAt(aside), bodyAt(-aside), bodyAt(0.0) }, aside,
          press.series().load(bodyAt(0.0), force));
      EXPECT_NEAR(lateral.x(), -slope, 5e-3 * std::abs(slope)) << tip.index() << ' ' << deepest;
      EXPECT_NEAR(lateral.y(), slope, 5e-3 * std::abs(slope)) << tip.index() << ' ' << deepest;
      EXPECT_EQ(lateral.z(), 0.0);
    }
  }
}

// over a near support the pull has an end: what is deeper goes on as steep, and says so
TEST(SeriesLaw, StaysStableOverANearSupport)
{
  const SeriesPress press(SphereTip{ 10.0_mm });
  double before = 0.0;
  bool isBeyond = false;
  for (double depth = 0.05_mm; depth < 8.0_mm; depth += 0.05_mm)
  {
    const SeriesResponse found = press({ .constant = -120.0 }, depth);
    EXPECT_GT(found.felt.force, before) << depth;
    EXPECT_TRUE(std::isfinite(found.felt.stiffness));
    EXPECT_GE(found.isBeyond, isBeyond);
    before = found.felt.force;
    isBeyond = found.isBeyond;
  }
  EXPECT_TRUE(isBeyond);
}

TEST(SeriesLaw, OfNoDepthIsNothingAndNeverAllocates)
{
  const SeriesPress press(SphereTip{ 10.0_mm });
  const test::AllocationGuard guard;
  for (const double depth : { 0.0, -1.0, std::nan("") })
  {
    EXPECT_EQ(press.force(kBodies[2], depth), 0.0);
  }
  EXPECT_GT(press.force(kBodies[2], 2.0_mm), 0.0);
  EXPECT_EQ(guard.count(), 0U);
}

// a plane of values whose gradient is twice the slope is told as it is
TEST(ComplianceField, FollowsWhatItsPlacesTell)
{
  std::vector<PlacedCompliance> places;
  const Eigen::Vector3d slope(40.0, -25.0, 0.0);
  for (int i = 0; i < 400; ++i)
  {
    const Eigen::Vector3d at((i % 20) * 4.0_mm, (i / 20) * 4.0_mm, 0.0);
    places.push_back({ .position = at, .constant = 7.0 + 2.0 * slope.dot(at), .slope = slope });
  }
  const ComplianceField field(places, 4.0_mm, kPoisson);
  const Eigen::Vector3d at(33.0_mm, 41.3_mm, 0.0);
  const ComplianceField::Local found = field.at(at, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(found.body.constant, 7.0 + 2.0 * slope.dot(at), 1e-4);
  EXPECT_NEAR(found.body.slope, slope.norm(), 1e-4);
  EXPECT_EQ(found.doubtful, 0.0);
  EXPECT_EQ(field.at(at + Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d::UnitZ()).doubtful, 1.0);
  EXPECT_EQ(field.at(at, -Eigen::Vector3d::UnitZ()).doubtful, 1.0);
}

// a ball's places tell of an edge on one side only; a tool above, whose foot on the face is
// another, is told what all of them tell
TEST(ComplianceField, DoesNotJumpWhereAnEdgeIsNoLongerTold)
{
  constexpr double slope = 8e3;
  const auto constantAt = [](double x) { return 300.0 + 2.0 * slope * x; };
  for (const double told : { 50.0, 20.0, 100.0 })
  {
    std::vector<PlacedCompliance> places;
    for (int i = -12; i <= 12; ++i)
    {
      for (int k = -12; k <= 12; ++k)
      {
        const Eigen::Vector3d out(0.1 * i, 0.1 * k, 1.0);
        PlacedCompliance& place = places.emplace_back();
        place.normal = out.normalized();
        place.position = 40.0_mm * place.normal;
        place.constant = constantAt(place.position.x());
        place.slope = { slope, 0.0, 0.0 };
        place.edge = place.position.x() > 1.0_mm ? told : 0.0;
      }
    }
    const ComplianceField field(places, 4.0_mm, kPoisson);
    double before = std::numeric_limits<double>::quiet_NaN();
    for (double x = -8.0_mm; x < 8.0_mm; x += 0.05_mm)
    {
      const Eigen::Vector3d normal = Eigen::Vector3d(x, 1.0_mm, 40.0_mm).normalized();
      for (const double height : { 0.0, 8.0_mm })
      {
        const double found = field.at(40.0_mm * normal, normal, height).body.constant;
        EXPECT_NEAR(found, constantAt(40.0_mm * normal.x()), 20.0) << told << ' ' << x;
        if (height > 0.0)
        {
          EXPECT_FALSE(std::abs(found - before) > 4.0) << told << ' ' << x;
          before = found;
        }
      }
    }
  }
}

// a ball on a curved body, where the places of a row lie beside an edge and those about it do not:
// it is as near to that edge as it is, however little the row says
TEST(ComplianceField, AnEdgeFadesOutAmongPlacesThatHaveNone)
{
  std::vector<PlacedCompliance> places;
  for (int i = 0; i < 400; ++i)
  {
    const Eigen::Vector3d at((i % 20) * 4.0_mm, (i / 20) * 4.0_mm, 0.0);
    places.push_back({ .position = at,
      .constant = 20.0,
      .slope = { 300.0, 0.0, 0.0 },
      .edge = i % 20 == 10 ? 50.0 : 0.0 });
  }
  const ComplianceField field(places, 4.0_mm, kPoisson);
  const Eigen::Vector3d leaning = Eigen::Vector3d(0.3, 0.0, 1.0).normalized();
  constexpr double kHeight = 10.0_mm;
  // over a distance, slope by slope, and four times so near to an edge
  constexpr double kMost = 4.0 * 2.0 * 300.0 * 0.3 * kHeight;
  for (double x = 20.0_mm; x < 60.0_mm; x += 0.1_mm)
  {
    const Eigen::Vector3d at(x, 38.0_mm, 0.0);
    const double told = field.at(at, leaning).body.constant;
    EXPECT_NEAR(field.at(at, leaning, kHeight).body.constant, told, kMost) << x;
  }
}

} // namespace
} // namespace palp
