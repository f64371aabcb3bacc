#include "calibration/study/case.h"

#include "calibration/study/outcome.h"
#include "tests/calibration/study/quick_case.h"

#include <array>

namespace palp::fem
{
namespace
{

using namespace units::literals;

std::string refusal(const Case& study)
{
  try
  {
    check(study);
  }
  catch (const Error& error)
  {
    EXPECT_EQ(error.code(), ErrorCode::BadValue);
    return error.what();
  }
  return {};
}

TEST(Study, RefusesAbsurdGeometryBeforeAnyWork)
{
  EXPECT_EQ(refusal(quick()), "");
  Case study = quick();
  study.tip = SphereTip{ 60.0_mm };
  EXPECT_NE(refusal(study).find("--tip"), std::string::npos);
  study = quick();
  study.threshold = 3.0_mm;
  EXPECT_NE(refusal(study).find("--threshold"), std::string::npos);
  study = quick();
  study.depths.back() = 60.0_mm;
  EXPECT_NE(refusal(study).find("--depth"), std::string::npos);
  study = quick();
  study.material.poissonRatio = 0.5;
  EXPECT_NE(refusal(study).find("--poisson"), std::string::npos);
  study = quick();
  study.model = BodyModel::Block;
  study.length = 80.0_mm;
  EXPECT_NE(refusal(study).find("--model"), std::string::npos);
  study = quick();
  study.tip = withCap(ConeTip{ .halfAngle = 24.0_deg, .baseRadius = 10.0_mm }, 0.3_mm);
  EXPECT_NE(refusal(study).find("give 25 degrees or more"), std::string::npos);
  study.energy = StrainEnergy::Linear;
  EXPECT_EQ(refusal(study), "");
}

// elements wider than evenly spaced ones do not fill the block, but overshoot it
TEST(Study, RefusesElementsThatABlockCannotHold)
{
  Case study = quick();
  study.model = BodyModel::Block;
  study.elementSize = 100.0_mm / 29.0;
  EXPECT_EQ(refusal(study), "");
  study.elementSize *= 1.001;
  EXPECT_NE(refusal(study).find("--element-size"), std::string::npos);
  study.width = study.length = 10.0_mm;
  study.height = 100.0_mm;
  study.tip = SphereTip{ 4.0_mm };
  study.elementSize = 20.0_mm;
  EXPECT_NE(refusal(study).find("--element-size"), std::string::npos);
}

class BlockOf : public testing::TestWithParam<std::array<double, 4>>
{
};
INSTANTIATE_TEST_SUITE_P(Study, BlockOf,
  testing::Values(std::array{ 100.0_mm, 50.0_mm, 10.0_mm, 0.0 },
    std::array{ 100.0_mm, 50.0_mm, 44.0_mm, 0.0 }, std::array{ 100.0_mm, 4.0_mm, 44.0_mm, 0.0 },
    std::array{ 10.0_mm, 100.0_mm, 4.0_mm, 10.0_mm / 29.0 },
    std::array{ 100.0_mm, 5.0_mm, 10.0_mm, 1.0_mm },
    std::array{ 100.0_mm, 50.0_mm, 10.0_mm, 0.01_mm }));

TEST_P(BlockOf, HasTheSizeThatWasAskedFor)
{
  const auto [width, height, radius, elementSize] = GetParam();
  Case study = quick();
  study.model = BodyModel::Block;
  study.width = study.length = width;
  study.height = height;
  study.tip = SphereTip{ radius };
  study.elementSize = elementSize;
  ASSERT_EQ(refusal(study), "");
  const Body body = bodyOf(study);
  EXPECT_NEAR(body.positions.row(0).maxCoeff(), 0.5 * width, 1e-9 * width);
  EXPECT_NEAR(body.positions.row(1).maxCoeff(), 0.5 * width, 1e-9 * width);
  EXPECT_NEAR(body.positions.row(2).minCoeff(), 0.0, 1e-9 * height);
  EXPECT_NEAR(body.positions.row(2).maxCoeff(), height, 1e-9 * height);
}

TEST(Study, AConeGetsATangentCap)
{
  const Tip capped = withCap(ConeTip{ .halfAngle = 45.0_deg, .baseRadius = 10.0_mm }, 0.3_mm);
  EXPECT_DOUBLE_EQ(std::get<BluntConeTip>(capped).tipRadius, 0.3_mm);
  EXPECT_TRUE(std::holds_alternative<SphereTip>(withCap(SphereTip{ 10.0_mm }, 0.3_mm)));
}

// the flank stays where it is, the flat loses what the edge takes: rounding tan(turn / 2)
TEST(Study, AFlatGetsARoundEdge)
{
  const Tip sharp = TruncatedConeTip{ 45.0_deg, 5.0_mm, 10.0_mm };
  const Tip round = withCap(sharp, 0.3_mm);
  EXPECT_NEAR(flatRadius(round), 5.0_mm - 0.3_mm * std::tan(22.5_deg), 1e-9);
  for (const double radius : { 6.0_mm, 8.0_mm, 10.0_mm })
  {
    EXPECT_NEAR(tipHeight(round, radius), tipHeight(sharp, radius), 1e-6);
  }
  EXPECT_NEAR(flatRadius(withCap(PunchTip{ 1.0_mm }, 0.3_mm)), 0.94_mm, 1e-9);
  EXPECT_TRUE(std::holds_alternative<PunchTip>(withCap(PunchTip{ 1.0_mm }, 0.0)));
}

TEST(Study, ExtentIsWhereTheDeformedSurfaceCrossesTheThreshold)
{
  const std::vector<IndentationStep::Point> profile{ { 0.0, 0.0, -3.0_mm },
    { 10.0_mm, 1.0_mm, -1.0_mm }, { 20.0_mm, 0.0, 0.0 } };
  EXPECT_DOUBLE_EQ(extentRadius(profile, 0.5_mm), 15.5_mm); // halfway from 11 to 20 mm
  EXPECT_EQ(extentRadius(profile, 3.0_mm), 0.0);
  EXPECT_DOUBLE_EQ(extentRadius({ profile[0], profile[1] }, 0.5_mm), 11.0_mm);
}

} // namespace
} // namespace palp::fem
