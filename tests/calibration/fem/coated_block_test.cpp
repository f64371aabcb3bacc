#include "calibration/fem/mesh.h"
#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/force/validity.h"
#include "tests/calibration/indentation_case.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace palp::fem
{
namespace
{

using namespace units::literals;

Coatings coatings(std::initializer_list<Coating> list)
{
  Coatings all;
  for (const Coating& coating : list)
  {
    all.add(coating);
  }
  return all;
}

const Material kTissue{ 10.0_kPa, 0.45 };
const Material kSkin{ 40.0_kPa, 0.45 };
const Material kFat{ 2.0_kPa, 0.48 };

Case coatedCase(const Coatings& coatings)
{
  return { .name = "coated",
    .width = 300.0_mm,
    .length = 300.0_mm,
    .height = 60.0_mm,
    .tip = SphereTip{ 10.0_mm },
    .material = kTissue,
    .coatings = coatings,
    .energy = StrainEnergy::Linear,
    .depths = { 0.5_mm, 1.0_mm, 2.0_mm, 4.0_mm },
    .elementSize = 0.25_mm };
}

class CoatedBlock : public ::testing::TestWithParam<Coatings>
{
};
std::string nameOf(const testing::TestParamInfo<Coatings>& sheets)
{
  constexpr std::array names{ "Skin", "Fat", "SkinOnFat" };
  return names[sheets.index];
}
INSTANTIATE_TEST_SUITE_P(Sheets, CoatedBlock,
  ::testing::Values(coatings({ { 2.0_mm, kSkin } }), coatings({ { 6.0_mm, kFat } }),
    coatings({ { 1.0_mm, kSkin }, { 8.0_mm, kFat } })),
  nameOf);

// elements know nothing of integral equations
TEST_P(CoatedBlock, LinearElementsMeetTheLaw)
{
  const Case study = coatedCase(GetParam());
  const ForceLaw law(study.tip, study.material,
    { .mode = LawMode::Corrected,
      .constitution = ConstitutiveModel::Linear,
      .coatings = GetParam() });
  double worst = 0.0;
  for (const IndentationStep& step : completed(study).steps)
  {
    const Response expected = law({ .depth = step.depth, .thickness = study.height });
    EXPECT_NEAR(step.force, expected.force, 0.005 * expected.force) << step.depth;
    // the elements' edge of contact moves with the surface, outwards where it is soft
    EXPECT_NEAR(step.contactRadius, expected.contactRadius, 0.08 * expected.contactRadius)
      << step.depth;
    worst = std::max(worst, std::abs(step.force / expected.force - 1.0));
  }
  RecordProperty("worst", std::to_string(worst));
}

// small strain of each neo-Hookean sheet is the linear one's
TEST_P(CoatedBlock, NeoHookeanSheetsBeginAsLinearOnes)
{
  Case study = coatedCase(GetParam());
  study.depths = { 0.05_mm };
  study.threshold = 0.01_mm;
  const double linear = completed(study).steps.front().force;
  study.energy = StrainEnergy::NeoHookean;
  EXPECT_NEAR(completed(study).steps.front().force, linear, 0.03 * linear);
}

// where the rule of large strain breaks, the linear law is still near; soon after it is not
TEST(CoatedBlocks, StiffSkinOnFatStretchesOncePressedDeeperThanItIsThick)
{
  Case study = coatedCase(coatings({ { 1.0_mm, kSkin }, { 8.0_mm, kFat } }));
  study.energy = StrainEnergy::NeoHookean;
  study.elementSize = 0.5_mm;
  study.depths = { 0.5_mm, 1.0_mm, 2.0_mm, 3.0_mm };
  const ForceLaw law(
    study.tip, study.material, { .mode = LawMode::Corrected, .coatings = study.coatings });
  const Validity validity(law);
  const auto steps = completed(study).steps;
  const auto shortOf = [&](std::size_t i)
  {
    return 1.0 - law({ .depth = steps[i].depth, .thickness = study.height }).force / steps[i].force;
  };
  const auto believed = [&](std::size_t i)
  {
    const Rules rules = validity({ .depth = steps[i].depth, .thickness = study.height });
    return std::ranges::all_of(rules,
      [](const Rule& rule)
      { return std::string_view(rule.name) != "large_strain" || rule.holds(); });
  };
  EXPECT_TRUE(believed(0) && believed(1));
  EXPECT_LT(shortOf(1), 0.08);
  EXPECT_FALSE(believed(2) || believed(3));
  EXPECT_GT(shortOf(3), 0.12);
}

TEST(CoatedBlocks, SheetsMeetTheirBoundsAndFillThem)
{
  const Coatings sheets = coatings({ { 1.5_mm, kSkin }, { 8.0_mm, kFat } });
  const Body body = cylinderBody(50.0_mm, 30.0_mm, 5.0_mm, 1.0_mm, sheets);
  double skin = 0.0;
  double fat = 0.0;
  double all = 0.0;
  for (const Element& element : body.elements)
  {
    double volume = 0.0;
    for (const IntegrationPoint& point : element.points)
    {
      volume += point.weight;
    }
    const double young = element.material ? element.material->youngModulus : 0.0;
    skin += young == kSkin.youngModulus ? volume : 0.0;
    fat += young == kFat.youngModulus ? volume : 0.0;
    all += volume;
  }
  EXPECT_NEAR(skin / all, 1.5 / 30.0, 1e-9);
  EXPECT_NEAR(fat / all, 8.0 / 30.0, 1e-9);
}

TEST(CoatedBlocks, RefuseWhatNoElementsCanHold)
{
  const auto refused = [](const Case& study, const char* word)
  {
    try
    {
      check(study);
    }
    catch (const Error& error)
    {
      return std::string(error.what()).starts_with(word);
    }
    return false;
  };
  EXPECT_TRUE(refused(coatedCase(coatings({ { 70.0_mm, kFat } })), "--coating"));
  EXPECT_TRUE(refused(coatedCase(coatings({ { 0.1_mm, kSkin } })), "--coating"));
  EXPECT_TRUE(refused(coatedCase(coatings({ { 2.0_mm, { 1.0_kPa, 0.5 } } })), "--coating"));
  Case block = coatedCase(coatings({ { 2.0_mm, kSkin } }));
  block.model = BodyModel::Block;
  EXPECT_TRUE(refused(block, "--coating"));
}

} // namespace
} // namespace palp::fem
