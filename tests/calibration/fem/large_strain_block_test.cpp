#include "haptics/force/force_law.h"
#include "haptics/force/validity.h"
#include "haptics/tip/profile.h"
#include "tests/calibration/indentation_case.h"
#include "tests/support/shipped_ratios.h"

#include <cmath>

// What the corrected law says of tools without a table of large strain, against elements that know
// nothing of it: within 3 %, or flagged.

namespace palp::fem
{
namespace
{

Tip quartic()
{
  std::vector<Profile::Point> points;
  for (int i = 0; i <= 40; ++i)
  {
    const double radius = i * 0.25_mm;
    points.push_back({ radius, 6.0_mm * std::pow(radius / 10.0_mm, 4) });
  }
  return ProfileTip{ std::make_shared<const Profile>(std::move(points)) };
}

struct Tool
{
  const char* name;
  Tip tip;
  double nu;
  double deepest;
  double height = 75.0_mm;
};

class LargeStrainBlock : public ::testing::TestWithParam<Tool>
{
};
INSTANTIATE_TEST_SUITE_P(Tools, LargeStrainBlock,
  ::testing::Values(Tool{ "ProfileAtNu0", quartic(), 0.0, 4.5_mm },
    Tool{ "ProfileAtNu45", quartic(), 0.45, 4.5_mm },
    Tool{ "ParaboloidAtNu0", ParaboloidTip{ 8.0_mm }, 0.0, 7.5_mm },
    Tool{ "ParaboloidAtNu49", ParaboloidTip{ 8.0_mm }, 0.49, 5.4_mm },
    Tool{ "WideConeAtNu0", BluntConeTip{ 70.0_deg, 0.3_mm, 12.0_mm }, 0.0, 4.2_mm },
    Tool{ "WideConeAtNu49", BluntConeTip{ 70.0_deg, 0.3_mm, 12.0_mm }, 0.49, 4.2_mm },
    Tool{ "SteepConeAtNu49", BluntConeTip{ 30.0_deg, 1.0_mm, 6.0_mm }, 0.49, 4.5_mm },
    Tool{
      "SteepBluntConeOnALayer", BluntConeTip{ 30.0_deg, 3.0_mm, 6.0_mm }, 0.45, 5.1_mm, 25.0_mm },
    Tool{
      "SteepTruncatedCone", TruncatedConeTip{ 20.0_deg, 2.0_mm, 4.0_mm }, 0.4, 2.1_mm, 30.0_mm },
    Tool{ "BluntConeAtNu2", BluntConeTip{ 60.0_deg, 2.0_mm, 10.0_mm }, 0.2, 4.5_mm },
    Tool{ "TruncatedConeAtNu0", TruncatedConeTip{ 45.0_deg, 3.0_mm, 8.0_mm }, 0.0, 4.5_mm },
    Tool{ "TruncatedConeAtNu49", TruncatedConeTip{ 45.0_deg, 3.0_mm, 8.0_mm }, 0.49, 4.5_mm },
    Tool{ "PunchAtNu0", PunchTip{ 8.0_mm }, 0.0, 3.0_mm },
    Tool{ "PunchOnALayer", PunchTip{ 4.0_mm }, 0.49, 3.0_mm, 12.0_mm },
    Tool{ "WideConeOnALayer", BluntConeTip{ 70.0_deg, 0.3_mm, 12.0_mm }, 0.49, 3.0_mm, 12.0_mm },
    Tool{ "ConeOnALayerAtNu45", BluntConeTip{ 60.0_deg, 0.3_mm, 9.0_mm }, 0.45, 4.5_mm, 10.0_mm },
    Tool{ "ConeOnALayerAtNu3", BluntConeTip{ 60.0_deg, 0.3_mm, 9.0_mm }, 0.3, 4.5_mm, 10.0_mm }),
  [](const auto& tool) { return tool.param.name; });

TEST_P(LargeStrainBlock, IsThatOfTheLawOrFlagged)
{
  const Tool& tool = GetParam();
  const Case study{ .name = "strain",
    .width = 150.0_mm,
    .length = 150.0_mm,
    .height = tool.height,
    .tip = withCap(tool.tip, 0.3_mm),
    .material = { 50.0_kPa, tool.nu },
    .depths = depthRange(tool.deepest / 3.0, tool.deepest, tool.deepest / 3.0) };
  const ForceLaw law(
    tool.tip, study.material, { .mode = LawMode::Corrected, .largeStrain = test::shippedRatios() });
  const Validity validity(law);
  const auto steps = completed(study).steps;
  ASSERT_EQ(steps.size(), 3U);
  double worst = 0.0;
  for (const IndentationStep& step : steps)
  {
    const ContactGeometry local{ .depth = step.depth, .thickness = study.height };
    const double error = law(local).force / step.force - 1.0;
    if (brokenRules(validity(local)) == 0)
    {
      EXPECT_LE(std::abs(error), 0.03) << step.depth;
      worst = std::max(worst, std::abs(error));
    }
  }
  RecordProperty("worst", std::to_string(worst));
}

} // namespace
} // namespace palp::fem
