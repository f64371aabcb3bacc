#include "haptics/force/nodules/nodule_increment.h"
#include "haptics/force/nodules/nodules.h"
#include "tests/haptics/force/nodules/nodule_cases.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kDeepest = 10.0_mm; // deeper than all rows, so that they lie within the table

bool isInRange(const test::ReferenceRow& row)
{
  return row.number("b_m") <= 8.0_mm && row.number("top_m") >= 2.0_mm &&
    row.number("a_hom_m") >= 2.0_mm;
}

test::NoduleCase caseOf(const test::ReferenceRow& row)
{
  return { .tip = test::tipOf(row),
    .poisson = row.number("nu"),
    .thickness = row.number("H_m"),
    .deepest = kDeepest };
}

std::string columnsOf(const test::ReferenceRow& row, std::initializer_list<const char*> names)
{
  std::string text;
  for (const char* name : names)
  {
    text += row.text(name) + ' ';
  }
  return text;
}

// presses and nodules of a table, each made once
class Baked
{
public:
  const HomogeneousPress& press(const test::ReferenceRow& row)
  {
    const std::string key = columnsOf(row, { "nu", "H_m", "tip", "R_m" });
    return presses_.try_emplace(key, caseOf(row).press()).first->second;
  }

  const Nodules& nodules(const test::ReferenceRow& row)
  {
    const std::string key = columnsOf(row, { "nu", "H_m", "tip", "R_m", "b_m", "top_m", "k" });
    const auto found = nodules_.find(key);
    if (found != nodules_.end())
    {
      return found->second;
    }
    const Nodule nodule = test::noduleOf(row);
    return nodules_.emplace(key, Nodules(press(row), std::span(&nodule, 1))).first->second;
  }

private:
  std::map<std::string, HomogeneousPress> presses_;
  std::map<std::string, Nodules> nodules_;
};

struct Tally
{
  int rows = 0;
  int met = 0;
  double worst = 0.0; // of F [-]

  // within 5 % of the increment or 1 % of the force
  void add(double force, double expected, double homogeneous)
  {
    ++rows;
    const double error = std::abs(force - expected);
    met += error <= std::max(0.05 * std::abs(expected - homogeneous), 0.01 * expected) ? 1 : 0;
    worst = std::max(worst, error / expected);
  }

  void expect(double fraction) const
  {
    EXPECT_GE(met, fraction * rows) << met << " of " << rows;
    ::testing::Test::RecordProperty("met", std::to_string(met) + " of " + std::to_string(rows));
    ::testing::Test::RecordProperty("worst_of_F", std::to_string(worst));
  }
};

TEST(NodulesReference, ForceIsThatOfFiniteElementsOnTheAxis)
{
  Baked baked;
  Tally tally;
  for (const test::ReferenceRow& row : test::referenceTable("nodule_onaxis"))
  {
    if (isInRange(row))
    {
      const double plain = row.number("F_hom_N");
      const double more = baked.nodules(row)(row.number("d_m"), std::array{ 0.0 }).response.force;
      tally.add(plain + more, row.number("F_nod_N"), plain);
    }
  }
  EXPECT_EQ(tally.rows, 324);
  tally.expect(0.95);
}

TEST(NodulesReference, ForceIsThatOfFiniteElementsOffTheAxis)
{
  Baked baked;
  Tally tally;
  double worstLateral = 0.0; // of the largest of a nodule [-]
  for (const test::ReferenceRow& row : test::referenceTable("nodule_offaxis"))
  {
    const double plain = row.number("F_hom_N");
    const double lateral = row.number("s_m");
    const Nodules::Answer answer =
      baked.nodules(row)(row.number("d_m"), std::array{ lateral * lateral });
    tally.add(plain + answer.response.force, row.number("F_nod_N"), plain);
    if (row.text("tip") == "sphere" && row.number("k") <= 5.0)
    {
      worstLateral = std::max(worstLateral,
        std::abs(answer.repulsion[0] * lateral - row.number("Q_N")) / row.number("F_nod_N"));
    }
  }
  EXPECT_GT(tally.rows, 50);
  tally.expect(0.95);
  EXPECT_LT(worstLateral, 0.01);
  RecordProperty("worst_lateral_of_F", std::to_string(worstLateral));
}

// the increments of first order, which an independent program computed
TEST(NodulesReference, IncrementsAreThoseOfTheOracle)
{
  double worst = 0.0;
  Baked baked;
  for (const test::ReferenceRow& row : test::referenceTable("nodule_onaxis"))
  {
    if (!isInRange(row))
    {
      continue;
    }
    const HomogeneousPress& press = baked.press(row);
    const std::vector<double> x = firstOrderIncrements(press, test::noduleOf(row), 0.0);
    const CubicSpline between(press.axis(), x);
    const double found = between(std::sqrt(row.number("d_m"))).value;
    worst = std::max(worst, std::abs(found / row.number("x") - 1.0));
  }
  EXPECT_GT(worst, 0.0);
  EXPECT_LT(worst, 0.01);
  RecordProperty("worst", std::to_string(worst));
}

TEST(NodulesReference, TwoNodulesAddUp)
{
  double worst = 0.0;
  int rows = 0;
  const std::array nodules{ Nodule{ 3.0_mm, 3.0_mm, 10.0 }, Nodule{ 5.0_mm, 20.0_mm, 5.0 } };
  std::map<std::string, Nodules> baked; // by tip
  for (const test::ReferenceRow& row : test::referenceTable("two_nodules_onaxis"))
  {
    ASSERT_EQ(row.text("case"), "T_n0.45_H40_b3_t3_k10_b5_t20_k5");
    const test::NoduleCase which{
      .tip = test::tipOf(row), .poisson = 0.45, .thickness = 40.0_mm, .deepest = kDeepest
    };
    const std::string key = columnsOf(row, { "tip", "R_m" });
    auto found = baked.find(key);
    if (found == baked.end())
    {
      found = baked.emplace(key, Nodules(which.press(), nodules)).first;
    }
    const double more = found->second(row.number("d_m"), std::array{ 0.0, 0.0 }).response.force;
    const double force = row.number("F_hom_N") + more;
    worst = std::max(worst, std::abs(force / row.number("F_nod_N") - 1.0));
    ++rows;
  }
  EXPECT_GT(rows, 10);
  EXPECT_LT(worst, 0.025);
  RecordProperty("worst", std::to_string(worst));
}

} // namespace
} // namespace palp
