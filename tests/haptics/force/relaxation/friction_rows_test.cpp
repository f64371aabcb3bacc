#include "haptics/force/relaxation/friction_rows.h"

#include "haptics/force/force_law.h"
#include "haptics/force/relaxation/relaxing_contact.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"
#include "tests/support/allocation_guard.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRowsPoisson = 0.45;

// A ball of 10 mm on a half-space of 10 kPa, dragged.
struct Dragged
{
  explicit Dragged(double mu, double deepest = 8.0_mm)
    : law(SphereTip{ 10.0_mm }, makeMaterial(10.0_kPa, kRowsPoisson))
    , rows(
        [this](double depth)
        {
          const Response at = law({ .depth = depth });
          return ElasticForce{ at.force, at.stiffness };
        },
        deepest)
    , tissue{ .coefficient = mu, .poissonRatio = kRowsPoisson }
  {
  }

  Eigen::Vector3d move(double depth, const Eigen::Vector3d& moved)
  {
    contact.predict(series, 1.0_ms);
    normalForce = contact.at(rows, depth).force;
    contact.settle(rows, depth);
    return friction.drag(rows, contact.loads(), tissue, Eigen::Vector3d::UnitZ(), moved);
  }

  ForceLaw law;
  ContactRows rows;
  FrictionRows::Tissue tissue;
  PronySeries series{};
  RelaxingContact contact{};
  FrictionRows friction{};
  double normalForce = 0.0;
};

class VersusMindlin : public ::testing::TestWithParam<std::pair<const char*, double>>
{
};

// 2000 rows of another program, 3e-7 off the closed forms of Cattaneo and Mindlin
TEST_P(VersusMindlin, ForceFollowsTheReference)
{
  const auto [name, mu] = GetParam();
  const auto table = test::referenceTable(name);
  ASSERT_EQ(table.size(), 2001u);
  Dragged dragged(mu);
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  double worst = 0.0;
  double most = 0.0;
  for (const auto& row : table)
  {
    const Eigen::Vector3d at(row.number("ux_m"), row.number("uy_m"), 0.0);
    const Eigen::Vector3d force = dragged.move(row.number("d_m"), at - last);
    last = at;
    const Eigen::Vector3d known(row.number("Qx_N"), row.number("Qy_N"), 0.0);
    worst = std::max(worst, (force - known).norm());
    most = std::max(most, mu * row.number("F_N"));
  }
  RecordProperty("worst", std::to_string(worst / most));
  EXPECT_LT(worst, 1e-3 * most);
}

INSTANTIATE_TEST_SUITE_P(FrictionRows, VersusMindlin,
  ::testing::Values(std::pair{ "friction_small_partial", 0.5 },
    std::pair{ "friction_stroke_constF", 0.3 }, std::pair{ "friction_varying_F", 0.3 }),
  [](const auto& each) { return std::string(each.param.first); });

// Cattaneo 1938: Q = mu F (1 - (1 - u / us)^1.5), us = 3 mu F (2 - nu) / (16 G a)
TEST(FrictionRows, SlipsFromTheBorderInwardAsCattaneoHasIt)
{
  const double mu = 0.4;
  const double depth = 4.0_mm;
  Dragged dragged(mu, depth);
  const double shear = 10.0_kPa / (2.0 * (1.0 + kRowsPoisson));
  const double limit = mu * dragged.law({ .depth = depth }).force;
  const double radius = std::sqrt(10.0_mm * depth);
  const double slip = 3.0 * limit * (2.0 - kRowsPoisson) / (16.0 * shear * radius);
  for (int i = 1; i <= 120; ++i)
  {
    const double force = dragged.move(depth, { 0.01 * slip, 0.0, 0.0 }).x();
    const double fraction = std::min(1.0, 0.01 * i);
    EXPECT_NEAR(force, limit * (1.0 - std::pow(1.0 - fraction, 1.5)), 1e-3 * limit) << i;
  }
}

TEST(FrictionRows, FullSlipIsCoulombsForceAgainstTheMotionWhateverItsDirection)
{
  Dragged dragged(0.3);
  for (int i = 0; i < 36; ++i)
  {
    const double angle = std::numbers::pi / 18.0 * i;
    const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d force = dragged.move(3.0_mm, 1e3 * along);
    const double coulomb = 0.3 * dragged.normalForce;
    EXPECT_NEAR(force.dot(along), coulomb, 1e-6 * coulomb);
    EXPECT_LE(force.norm(), (1.0 + 1e-12) * coulomb);
  }
}

TEST(FrictionRows, IsNothingWithoutFrictionOrContact)
{
  Dragged smooth(0.0);
  EXPECT_EQ(smooth.move(3.0_mm, { 1.0_mm, 0.0, 0.0 }), Eigen::Vector3d::Zero());
  Dragged rough(0.5);
  EXPECT_GT(rough.move(3.0_mm, { 1.0_mm, 0.0, 0.0 }).norm(), 0.0);
  EXPECT_EQ(rough.move(-1.0_mm, { 1.0_mm, 0.0, 0.0 }), Eigen::Vector3d::Zero());
  EXPECT_EQ(rough.move(3.0_mm, Eigen::Vector3d::Zero()), Eigen::Vector3d::Zero()) << "forgotten";
}

TEST(FrictionRows, StaysInThePlaneOfTheSurface)
{
  Dragged dragged(0.5);
  const Eigen::Vector3d force = dragged.move(3.0_mm, { 1.0_mm, 0.5_mm, -2.0_mm });
  EXPECT_EQ(force.z(), 0.0);
  EXPECT_GT(force.x(), 0.0);
}

// where it ends as it began, lifted, all work went in
TEST(FrictionRows, NeverGivesMoreEnergyThanItGot)
{
  std::mt19937 random(5);
  const auto uniform = [&](double from, double to)
  { return std::uniform_real_distribution<double>(from, to)(random); };
  double least = 0.0;
  Dragged dragged(0.3);
  for (int history = 0; history < 1000; ++history)
  {
    dragged.tissue.coefficient = uniform(0.05, 1.0);
    double work = 0.0;
    Eigen::Vector3d drag = Eigen::Vector3d::Zero();
    const double fx = uniform(1.0, 12.0);
    const double fy = uniform(1.0, 12.0);
    const double fz = uniform(0.5, 8.0);
    Eigen::Vector3d last = Eigen::Vector3d::Zero();
    for (int i = 1; i <= 300; ++i)
    {
      const double turn = 2.0 * std::numbers::pi * 1.0_ms * i;
      const Eigen::Vector3d at(
        2.0_mm * std::sin(fx * turn), 1.0_mm * (1.0 - std::cos(fy * turn)), 0.0);
      const double next = i == 300 ? 0.0 : 4.0_mm * std::sin(0.5 * fz * turn);
      const Eigen::Vector3d now = dragged.move(next, at - last);
      work += 0.5 * (drag + now).dot(at - last);
      drag = now;
      last = at;
    }
    least = std::min(least, work);
  }
  RecordProperty("least_dissipation_J", std::to_string(least * 1e9) + "e-9");
  EXPECT_GE(least, -1e-9);
}

TEST(FrictionRows, DoesNotAllocate)
{
  Dragged dragged(0.5);
  const test::AllocationGuard guard;
  (void)dragged.move(3.0_mm, { 1.0_mm, 0.0, 0.0 });
  (void)dragged.move(1.0_mm, { 0.0, 1.0_mm, 0.0 });
  EXPECT_EQ(guard.count(), 0u);
}

// what was moved, told from the force alone
TEST(FrictionRows, ForceTellsHowFarTheTissueWasCarried)
{
  constexpr double kDepth = 4.0_mm;
  constexpr int kSteps = 400;
  Dragged dragged(0.3);
  (void)dragged.move(kDepth, Eigen::Vector3d::Zero());
  const Response at = dragged.law({ .depth = kDepth });
  const double shear = dragged.law.material().shearModulus();
  // of Cattaneo's, from where on all of it slips
  const double most =
    3.0 * 0.3 * at.force * (2.0 - kRowsPoisson) / (16.0 * shear * at.contactRadius);
  for (int i = 1; i <= 2 * kSteps; ++i)
  {
    const Eigen::Vector3d force = dragged.move(kDepth, most / kSteps * Eigen::Vector3d::UnitX());
    const double moved = most * i / kSteps;
    const double told = carriedBy(force.norm(), at.force, dragged.tissue, shear, at.contactRadius);
    EXPECT_NEAR(told, std::min(moved, most), 0.03 * most) << i;
  }
  EXPECT_EQ(carriedBy(1.0, 0.0, dragged.tissue, shear, at.contactRadius), 0.0);
  EXPECT_EQ(carriedBy(1.0, 1.0, dragged.tissue, shear, 0.0), 0.0);
}

} // namespace
} // namespace palp
