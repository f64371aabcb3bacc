#include "haptics/force/series/series_law.h"

#include "haptics/force/linear/series_contact.h"
#include "haptics/units.h"
#include "tests/support/allocation_guard.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kYoung = 50.0_kPa;
constexpr double kPoisson = 0.45;

ForceLaw exact(const Tip& tip)
{
  LawSettings settings;
  settings.mode = LawMode::Exact;
  return { tip, makeMaterial(kYoung, kPoisson), settings };
}

SeriesResponse pressed(const ForceLaw& law, const BodyCompliance& body, double depth)
{
  return SeriesLaw(law)([&](double at) noexcept { return law({ .depth = at }); }, body, depth);
}

const BodyCompliance kBodies[] = { {}, { .constant = 30.0 }, { .constant = 800.0, .slope = 9e3 },
  { .constant = -12.0, .bend = 5e3 }, { .constant = 60.0, .slope = 4e3, .bend = -4e3 },
  { .constant = 150.0, .slope = 4.2e4, .edge = 500.0 },
  { .constant = 25.0, .slope = 2.6e3, .bend = 2e3, .edge = 125.0 } };

// bisection of the same law by its half-space alone
TEST(SeriesLaw, IsTheRootThatHalvingFinds)
{
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  const HalfSpace contact(SphereTip{ 10.0_mm });
  const double modulus = law.material().contactModulus();
  for (const BodyCompliance& body : kBodies)
  {
    for (const double depth : { 0.01_mm, 0.5_mm, 2.0_mm, 6.0_mm })
    {
      const SeriesContact halved = inSeries(contact, body, depth, 10.0_mm);
      const SeriesResponse found = pressed(law, body, depth);
      EXPECT_NEAR(found.felt.force, modulus * halved.contact.force, 2e-4 * found.felt.force)
        << body.constant << ' ' << depth;
      EXPECT_NEAR(found.local, halved.local, 2e-4 * depth);
      EXPECT_FALSE(found.isBeyond);
    }
  }
}

TEST(SeriesLaw, OfAFlatPunchIsThatOfTwoSprings)
{
  const double a = 5.0_mm;
  const ForceLaw law = exact(PunchTip{ a });
  const double modulus = law.material().contactModulus();
  for (const double constant : { -40.0, 3.0, 200.0, 5000.0 })
  {
    const SeriesResponse found = pressed(law, { .constant = constant }, 2.0_mm);
    const double stiffness = modulus / (1.0 / (2.0 * a) + constant);
    EXPECT_NEAR(found.felt.force, stiffness * 2.0_mm, 1e-6 * found.felt.force) << constant;
    EXPECT_NEAR(found.felt.stiffness, stiffness, 1e-6 * stiffness);
  }
}

TEST(SeriesLaw, ItsStiffnessIsTheSlopeOfItsForce)
{
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  for (const BodyCompliance& body : kBodies)
  {
    for (const double depth : { 0.5_mm, 3.0_mm, 7.0_mm })
    {
      constexpr double step = 1e-7;
      const double slope = (pressed(law, body, depth + step).felt.force -
                             pressed(law, body, depth - step).felt.force) /
        (2.0 * step);
      EXPECT_NEAR(pressed(law, body, depth).felt.stiffness, slope, 1e-4 * slope);
    }
  }
}

// U = F d - U*, whose derivative by the depth is the force
TEST(SeriesLaw, ItsEnergyIsTheWorkOfItsForce)
{
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  const SeriesLaw series(law);
  for (const BodyCompliance& body : kBodies)
  {
    constexpr int parts = 1000;
    constexpr double deepest = 6.0_mm;
    double work = 0.0;
    double local = 0.0; // of the contact alone
    for (int i = 0; i < parts; ++i)
    {
      const double depth = deepest * (i + 0.5) / parts;
      work += pressed(law, body, depth).felt.force * deepest / parts;
    }
    const SeriesResponse last = pressed(law, body, deepest);
    for (int i = 0; i < parts; ++i)
    {
      local += law({ .depth = last.local * (i + 0.5) / parts }).force * last.local / parts;
    }
    const double complementary =
      last.felt.force * last.local - local + series.energy(body, last.felt.force);
    EXPECT_NEAR(last.felt.force * deepest - complementary, work, 1e-4 * work) << body.constant;
  }
}

// of a body that changes along the surface, at the same depth
TEST(SeriesLaw, ItsLateralForceIsTheSlopeOfTheEnergy)
{
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  const SeriesLaw series(law);
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
        work += pressed(law, bodyAt(s), deepest * (i + 0.5) / parts).felt.force * deepest / parts;
      }
      return work;
    };
    constexpr double step = 0.1_mm;
    const double slope = (energy(step) - energy(-step)) / (2.0 * step);
    ComplianceField::Local local;
    local.body = bodyAt(0.0);
    local.constant = Eigen::Vector3d(3e3, 0.0, 0.0);
    local.slope = Eigen::Vector3d(2e5, 0.0, 0.0);
    local.bend = Eigen::Vector3d(4e5, 0.0, 0.0);
    local.edge = Eigen::Vector3d(2e4, 0.0, 0.0);
    const double force = pressed(law, bodyAt(0.0), deepest).felt.force;
    EXPECT_NEAR(series.lateral(local, force).x(), -slope, 5e-3 * std::abs(slope)) << deepest;
  }
}

// over a near support the pull has an end: what is deeper goes on as steep, and says so
TEST(SeriesLaw, StaysStableOverANearSupport)
{
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  double before = 0.0;
  bool isBeyond = false;
  for (double depth = 0.05_mm; depth < 8.0_mm; depth += 0.05_mm)
  {
    const SeriesResponse found = pressed(law, { .constant = -120.0 }, depth);
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
  const ForceLaw law = exact(SphereTip{ 10.0_mm });
  const SeriesLaw series(law);
  const auto contact = [&](double at) noexcept { return law({ .depth = at }); };
  const test::AllocationGuard guard;
  for (const double depth : { 0.0, -1.0, std::nan("") })
  {
    EXPECT_EQ(series(contact, kBodies[2], depth).felt.force, 0.0);
  }
  EXPECT_GT(series(contact, kBodies[2], 2.0_mm).felt.force, 0.0);
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
  EXPECT_NEAR((found.constant - 2.0 * slope).norm(), 0.0, 1e-2);
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
