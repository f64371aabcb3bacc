#include "haptics/force/relaxation/relaxing_contact.h"

#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/relaxation/press_history.h"
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

ContactRows rowsOf(const ForceLaw& law, double deepest)
{
  return ContactRows(
    [&](double depth)
    {
      const Response at = law({ .depth = depth });
      return ElasticForce{ at.force, at.stiffness };
    },
    deepest);
}

PronySeries seriesOf(const std::vector<PronyTerm>& terms)
{
  PronySeries series;
  for (const PronyTerm& term : terms)
  {
    series.add(term);
  }
  return series;
}

// Tissue and its clock.
struct Tissue
{
  ContactRows rows;
  PronySeries series;
  RelaxingContact contact{};

  double press(double depth, double dt)
  {
    contact.predict(series, dt);
    const double force = contact.at(rows, depth).force;
    contact.settle(rows, depth);
    return force;
  }
};

struct Case
{
  const char* table;
  Tip tip;
  double modulus; // instantaneous
  std::vector<PronyTerm> terms;
};

class VersusTing : public ::testing::TestWithParam<Case>
{
};

// 1500 rows at 0.1 ms and quadrature of Ting's integrals, another program
TEST_P(VersusTing, ForceFollowsTheReference)
{
  const Case& the = GetParam();
  const auto table = test::referenceTable(the.table);
  ASSERT_GT(table.size(), 700u);
  double deepest = 0.0;
  double strongest = 0.0;
  for (const auto& row : table)
  {
    deepest = std::max(deepest, row.number("d_m"));
    strongest = std::max(strongest, row.number("F_N"));
  }
  std::vector<PressPoint> history;
  for (const auto& row : table)
  {
    history.push_back({ row.number("t_s"), row.number("d_m") });
  }
  const ForceLaw law(the.tip, makeMaterial(the.modulus, 0.45));
  const std::vector<double> forces = forcesOver(rowsOf(law, deepest), seriesOf(the.terms), history);
  double loading = 0.0;
  double all = 0.0;
  bool isFirst = true;
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const double error = std::abs(forces[i] - table[i].number("F_N")) / strongest;
    isFirst = isFirst && (i == 0 || history[i].depth >= history[i - 1].depth);
    loading = std::max(loading, isFirst ? error : 0.0);
    all = std::max(all, error);
  }
  RecordProperty("loading", std::to_string(loading));
  RecordProperty("all", std::to_string(all));
  EXPECT_LT(loading, 2e-4);
  EXPECT_LT(all, 1e-3);
}

const std::vector<PronyTerm> kOne{ { 0.5, 0.2 } };
const std::vector<PronyTerm> kTwo{ { 0.3, 0.05 }, { 0.3, 0.6 } };

INSTANTIATE_TEST_SUITE_P(RelaxingContact, VersusTing,
  ::testing::Values(Case{ "visco_ramp_v20", SphereTip{ 10.0_mm }, 20.0_kPa, kOne },
    Case{ "visco_ramp_v60back", SphereTip{ 10.0_mm }, 20.0_kPa, kOne },
    Case{ "visco_cone_ramp", ConeTip{ 45.0_deg, 10.0_mm }, 20.0_kPa, kOne },
    Case{ "visco_sin1", SphereTip{ 10.0_mm }, 20.0_kPa, kOne },
    Case{ "visco_sin3", SphereTip{ 10.0_mm }, 20.0_kPa, kTwo },
    Case{ "visco_step", SphereTip{ 10.0_mm }, 20.0_kPa, kTwo }),
  [](const auto& each) { return std::string(each.param.table); });

TEST(RelaxingContact, IsTheElasticLawWhereNothingRelaxes)
{
  for (const Tip& tip : { Tip(SphereTip{ 10.0_mm }), Tip(ConeTip{ 30.0_deg, 10.0_mm }),
         Tip(PunchTip{ 5.0_mm }), Tip(TruncatedConeTip{ 45.0_deg, 2.0_mm, 10.0_mm }) })
  {
    const ForceLaw law(tip, makeMaterial(50.0_kPa, 0.45), { .mode = LawMode::Exact });
    Tissue tissue{ rowsOf(law, 8.0_mm), {} };
    for (const double edge : tissue.rows.edges)
    {
      const double force = law({ .depth = edge }).force;
      EXPECT_NEAR(tissue.press(edge, 1.0_ms), force, 1e-9 * force) << edge;
      EXPECT_EQ(tissue.press(-1.0_mm, 1.0_ms), 0.0);
      EXPECT_EQ(tissue.contact.surfaceDepth(), 0.0);
    }
  }
}

// E(0) and E(infinite) instead of E
TEST(RelaxingContact, RateLimitsAreTheInstantaneousAndTheLastingModulus)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  const double elastic = law({ .depth = 5.0_mm }).force;
  Tissue fast{ rowsOf(law, 5.0_mm), seriesOf(kTwo) };
  EXPECT_NEAR(fast.press(5.0_mm, 0.0), elastic, 1e-9 * elastic);
  EXPECT_NEAR(fast.press(5.0_mm, 60.0), 0.4 * elastic, 1e-9 * elastic);
  Tissue slow{ rowsOf(law, 5.0_mm), seriesOf(kTwo) };
  for (int i = 1; i < 100; ++i)
  {
    (void)slow.press(0.01 * i * 5.0_mm, 100.0);
  }
  EXPECT_NEAR(slow.press(5.0_mm, 1e6), 0.4 * elastic, 1e-6 * elastic);
}

// for a ramp of force in a spring law F = k d: E(t) by hand
TEST(RelaxingContact, APunchFollowsTheIntegralOfTheRelaxation)
{
  const ForceLaw law(PunchTip{ 5.0_mm }, makeMaterial(20.0_kPa, 0.45), { .mode = LawMode::Exact });
  const double stiffness = law({ .depth = 1.0_mm }).stiffness;
  Tissue tissue{ rowsOf(law, 5.0_mm), seriesOf(kOne) };
  double force = 0.0;
  for (int i = 1; i <= 500; ++i)
  {
    force = tissue.press(i * 0.01_mm, 1.0_ms);
  }
  const double hand = stiffness * 0.01 * (0.5 * 0.5 + 0.5 * 0.2 * (1.0 - std::exp(-0.5 / 0.2)));
  EXPECT_NEAR(force, hand, 1e-9 * hand);
}

TEST(RelaxingContact, LeavesADentThatRecovers)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  Tissue tissue{ rowsOf(law, 5.0_mm), seriesOf(kOne) };
  for (int i = 0; i < 1000; ++i)
  {
    (void)tissue.press(5.0_mm, 1.0_ms);
  }
  EXPECT_EQ(tissue.press(0.0, 1.0_ms), 0.0);
  // a spring of 0.5 beside one of 0.5 with a dashpot: the surface jumps to where both balance, then
  // creeps back with tau E(0) / E(infinite)
  const double jumped = tissue.contact.surfaceDepth();
  const double held = 1.0 - std::exp(-1.0 / 0.2);
  EXPECT_NEAR(jumped, 0.5 * held * 5.0_mm, 0.01 * 5.0_mm);
  (void)tissue.press(0.0, 0.0);
  for (int i = 0; i < 400; ++i)
  {
    EXPECT_EQ(tissue.press(0.0, 1.0_ms), 0.0);
  }
  EXPECT_NEAR(tissue.contact.surfaceDepth(), jumped * std::exp(-0.4 / (0.2 / 0.5)), 0.002 * jumped);
  EXPECT_EQ(tissue.press(0.9 * tissue.contact.surfaceDepth(), 1.0_ms), 0.0) << "above its bottom";
  for (int i = 0; i < 20000; ++i)
  {
    (void)tissue.press(0.0, 1.0_ms);
  }
  EXPECT_EQ(tissue.contact.surfaceDepth(), 0.0);
}

TEST(RelaxingContact, AFadedDentHoldsLessEnergy)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  Tissue tissue{ rowsOf(law, 5.0_mm), seriesOf(kTwo) };
  (void)tissue.press(5.0_mm, 1.0_ms);
  (void)tissue.press(5.0_mm, 1.0);
  (void)tissue.press(0.0, 1.0_ms);
  const double energy = tissue.contact.energy(tissue.rows, tissue.series);
  tissue.contact.fade(0.5);
  EXPECT_NEAR(tissue.contact.energy(tissue.rows, tissue.series), 0.25 * energy, 1e-12 * energy);
  tissue.contact.fade(0.0);
  EXPECT_EQ(tissue.contact.surfaceDepth(), 0.0);
}

TEST(RelaxingContact, FactorsMakeItTheLawOfAnotherPlace)
{
  const ForceLaw here(
    SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45), { .mode = LawMode::Corrected });
  const auto there = [&](double depth)
  { return here({ .depth = depth, .thickness = 30.0_mm, .surfaceCurvature = 15.0 }); };
  const ContactRows usual = rowsOf(here, 20.0_mm);
  Tissue tissue{ usual, {} };
  tissue.rows.adapt(usual, 10.0_mm,
    [&](double depth) noexcept
    {
      const Response at = there(depth);
      return ElasticForce{ at.force, at.stiffness };
    });
  for (const double depth : { 1.0_mm, 2.5_mm, 5.0_mm, 8.0_mm, 9.9_mm })
  {
    const double force = there(depth).force;
    EXPECT_NEAR(tissue.press(depth, 1.0_ms), force, 1e-3 * force) << depth;
  }
}

// a hand that comes, goes and trembles; dissipation from the work that was done
TEST(RelaxingContact, NeverGivesMoreEnergyThanItGot)
{
  std::mt19937 random(17);
  const auto uniform = [&](double from, double to)
  { return std::uniform_real_distribution<double>(from, to)(random); };
  const ForceLaw sphere(SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  const ForceLaw cone(ConeTip{ 45.0_deg, 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  const std::array laws{ rowsOf(sphere, 8.0_mm), rowsOf(cone, 8.0_mm) };
  double least = 0.0;
  for (int history = 0; history < 1000; ++history)
  {
    const double first = uniform(0.05, 0.45);
    Tissue tissue{ laws[static_cast<std::size_t>(history % 2)],
      seriesOf({ { first, uniform(0.02, 0.5) }, { uniform(0.05, 0.45), uniform(0.05, 2.0) } }) };
    std::array<double, 3> size{};
    std::array<double, 3> frequency{};
    std::array<double, 3> phase{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      size[k] = uniform(0.2_mm, 3.0_mm);
      frequency[k] = uniform(0.5, 12.0);
      phase[k] = uniform(0.0, 2.0 * std::numbers::pi);
    }
    double force = 0.0;
    double depth = 0.0;
    double work = 0.0;
    for (int i = 1; i <= 1200; ++i) // short ticks, for the integral of the work
    {
      const double time = 0.5_ms * i;
      double next = 2.0_mm;
      for (std::size_t k = 0; k < 3; ++k)
      {
        next += size[k] * std::sin(2.0 * std::numbers::pi * frequency[k] * time + phase[k]);
      }
      next *= std::min({ 1.0, i / 100.0, (1200 - i) / 100.0 }); // from rest, and lifted at the end
      const double after = tissue.press(next, 0.5_ms);
      EXPECT_GE(after, 0.0);
      work += 0.5 * (force + after) * (next - depth);
      force = after;
      depth = next;
      if (force == 0.0) // lifted: a cycle has ended
      {
        least = std::min(least, work - tissue.contact.energy(tissue.rows, tissue.series));
      }
    }
  }
  RecordProperty("least_dissipation_J", std::to_string(least * 1e9) + "e-9");
  EXPECT_GE(least, -1e-9);
}

TEST(RelaxingContact, DoesNotAllocate)
{
  const ForceLaw law(SphereTip{ 10.0_mm }, makeMaterial(20.0_kPa, 0.45));
  Tissue tissue{ rowsOf(law, 5.0_mm), seriesOf(kTwo) };
  const test::AllocationGuard guard;
  (void)tissue.press(5.0_mm, 1.0_ms);
  (void)tissue.press(1.0_mm, 1.0_ms);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(PronySeries, RefusesWhatNoTissueDoes)
{
  PronySeries series;
  EXPECT_THROW(series.add({ 0.0, 1.0 }), Error);
  EXPECT_THROW(series.add({ -0.1, 1.0 }), Error);
  EXPECT_THROW(series.add({ std::nan(""), 1.0 }), Error);
  EXPECT_THROW(series.add({ 1.0, 1.0 }), Error);
  EXPECT_THROW(series.add({ 0.5, 0.0 }), Error);
  EXPECT_THROW(series.add({ 0.5, -1.0 }), Error);
  EXPECT_THROW(series.add({ 0.5, std::nan("") }), Error);
  series.add({ 0.6, 1.0 });
  EXPECT_THROW(series.add({ 0.4, 2.0 }), Error);
  series.add({ 0.3, 2.0 });
  EXPECT_NEAR(series.lasting(), 0.1, 1e-15);
}

} // namespace
} // namespace palp
