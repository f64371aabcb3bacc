#include "calibration/fem/mesh.h"
#include "calibration/study/outcome.h"
#include "haptics/error.h"
#include "tests/calibration/indentation_case.h"
#include "tests/haptics/force/reference_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palp::fem
{
namespace
{

using namespace units::literals;

Case noduleCase(double radius, double top, double ratio)
{
  return { .name = "nodule",
    .width = 300.0_mm,
    .length = 300.0_mm,
    .height = 40.0_mm,
    .tip = SphereTip{ 10.0_mm },
    .material = { 50.0_kPa, 0.45 },
    .nodule = { radius, top, { ratio * 50.0_kPa, 0.45 } },
    .energy = StrainEnergy::Linear,
    .depths = { 1.0_mm, 2.0_mm, 4.0_mm },
    .elementSize = 0.4_mm };
}

class NoduleBlock : public ::testing::TestWithParam<std::array<double, 3>>
{
};
INSTANTIATE_TEST_SUITE_P(Nodules, NoduleBlock,
  ::testing::Values(std::array{ 5.0_mm, 5.0_mm, 5.0 }, std::array{ 5.0_mm, 5.0_mm, 0.2 },
    std::array{ 8.0_mm, 5.0_mm, 10.0 }, std::array{ 5.0_mm, 2.0_mm, 5.0 }));

// data/reference/nodule_onaxis.csv: other finite elements, with six nodes, and another contact
TEST_P(NoduleBlock, ForceFollowsOtherElements)
{
  const auto [radius, top, ratio] = GetParam();
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  const Outcome outcome = completed(noduleCase(radius, top, ratio));
  std::size_t rows = 0;
  for (const test::ReferenceRow& row : test::referenceTable("nodule_onaxis"))
  {
    const bool isThis = row.text("tip") == "sphere" && same(row.number("R_m"), 10.0_mm) &&
      same(row.number("nu"), 0.45) && same(row.number("H_m"), 40.0_mm) &&
      same(row.number("b_m"), radius) && same(row.number("top_m"), top) &&
      same(row.number("k"), ratio);
    for (const IndentationStep& step : outcome.steps)
    {
      if (isThis && same(step.depth, row.number("d_m")))
      {
        const double expected = row.number("F_nod_N");
        EXPECT_NEAR(step.force, expected, 0.015 * expected) << step.depth;
        ++rows;
      }
    }
  }
  EXPECT_GE(rows, 2U);
}

// data/reference/nodule_surface.csv
TEST(NoduleBlock, SurfaceFollowsOtherElements)
{
  std::size_t rows = 0;
  for (const test::ReferenceRow& row : test::referenceTable("nodule_surface"))
  {
    if (row.number("d_m") > 5.0_mm || row.text("case").starts_with("b8"))
    {
      continue;
    }
    Case study = noduleCase(5.0_mm, 5.0_mm, row.text("case").ends_with("k5") ? 5.0 : 0.2);
    study.depths = { row.number("d_m") };
    const IndentationStep step = completed(study).steps.front();
    EXPECT_NEAR(extentRadius(step.profile, 0.5_mm), row.number("Rd_nod_m"), 0.3_mm)
      << row.text("case") << ' ' << step.depth;
    ++rows;
  }
  EXPECT_EQ(rows, 4U);
}

// the border of the ball is one of elements, and their volume is its own
TEST(NoduleBlock, ElementsFollowTheBall)
{
  const Body body = bodyOf(noduleCase(8.0_mm, 3.0_mm, 10.0));
  double ball = 0.0;
  double all = 0.0;
  for (const Element& element : body.elements)
  {
    for (const IntegrationPoint& point : element.points)
    {
      EXPECT_GT(point.weight, 0.0);
      all += point.weight;
      ball += element.material ? point.weight : 0.0;
    }
  }
  const double expected = 4.0 / 3.0 * std::numbers::pi * std::pow(8.0_mm, 3);
  EXPECT_NEAR(ball, expected, 1e-3 * expected);
  const double block = 0.3 * 0.3 * 0.04;
  EXPECT_NEAR(all, block, 1e-6 * block);
}

TEST(NoduleBlock, NoNoduleOutsideTheBlockIsTaken)
{
  const auto refusal = [](const Case& study) -> std::string
  {
    try
    {
      check(study);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(noduleCase(5.0_mm, 5.0_mm, 5.0)), "");
  EXPECT_TRUE(refusal(noduleCase(19.0_mm, 5.0_mm, 5.0)).starts_with("--nodule:"));
  EXPECT_TRUE(refusal(noduleCase(5.0_mm, 0.3_mm, 5.0)).starts_with("--nodule:"));
  Case block = noduleCase(5.0_mm, 5.0_mm, 5.0);
  block.model = BodyModel::Block;
  EXPECT_TRUE(refusal(block).starts_with("--nodule:"));
}

} // namespace
} // namespace palp::fem
