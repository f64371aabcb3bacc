#include "tests/calibration/organ/body_scene.h"

#include <array>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;
using test::Body;

class OrganOfTwoModuli : public testing::TestWithParam<Body>
{
};

TEST_P(OrganOfTwoModuli, IsFeltWithItsMapAsByFiniteElements)
{
  test::expectForceOfElements(GetParam());
}

// a map beside the body's compliance tells nothing twice: a root that is stiffer or softer than the
// lobe, and tissue below and beside the tool
INSTANTIATE_TEST_SUITE_P(Organ, OrganOfTwoModuli,
  testing::Values(Body{ .file = "two_lobe30_stiff_root",
                    .size = { 0.06, 0.1, 0.03 },
                    .place = -0.01,
                    .isLobe = true,
                    .border = { 9.13004475_mm, 0.0, 0.0 },
                    .ratio = 4.0 },
    Body{ .file = "two_lobe30_soft_root",
      .size = { 0.06, 0.1, 0.03 },
      .place = -0.01,
      .isLobe = true,
      .border = { 9.13004475_mm, 0.0, 0.0 },
      .ratio = 0.3 },
    Body{ .file = "two_block_stiff_below",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 0.0, 0.0, -21.76701513_mm },
      .ratio = 5.0 },
    Body{ .file = "two_block_soft_below",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 0.0, 0.0, -21.76701513_mm },
      .ratio = 0.2 },
    Body{ .file = "two_block_near_stiff",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 0.0, 0.0, -13.04210875_mm },
      .ratio = 4.0 },
    Body{ .file = "two_block_near_soft",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 0.0, 0.0, -13.04210875_mm },
      .ratio = 0.3 },
    Body{ .file = "two_block_side_stiff",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 11.69871864_mm, 0.0, 0.0 },
      .ratio = 4.0 },
    Body{ .file = "two_block_side_soft",
      .size = { 0.1, 0.1, 0.05 },
      .border = { 11.69871864_mm, 0.0, 0.0 },
      .ratio = 0.3 }),
  [](const auto& body) { return std::string(body.param.file); });

TEST(OrganLobeOfTwoModuli, NoLoopGivesEnergy)
{
  const Scene scene = test::sceneOf({ .file = "",
                                      .size = { 0.06, 0.1, 0.03 },
                                      .place = -0.01,
                                      .isLobe = true,
                                      .border = { 4.0_mm, 0.0, 0.0 },
                                      .ratio = 3.0 },
    24.0_mm);
  EXPECT_LT(test::gainOfLoop(scene, -18.0_mm, 0.0), 0.01);
  EXPECT_LT(test::gainOfLoop(scene, 0.0, -18.0_mm), 0.01);
}

// across a border that reaches the surface, by any cells: against finite elements of 1.25 mm (N, E
// of 10 kPa, border at 4 mm, 3 mm deep), and in a slide nothing jumps
TEST(OrganBesideStifferTissue, TheForceGrowsWithoutAJump)
{
  for (const auto& [cell, limit] : { std::pair{ 6.0_mm, 0.2 }, std::pair{ 3.0_mm, 0.15 } })
  {
    const Scene scene = test::sceneOf({ .file = "",
                                        .size = { 0.06, 0.06, 0.03 },
                                        .border = { 4.0_mm, 0.0, 0.0 },
                                        .ratio = 4.0,
                                        .cell = cell },
      24.0_mm);
    const auto force = [&](double x) { return step(scene, test::at(x, 3.0_mm)).response.force; };
    constexpr std::array kForces{ std::pair{ 0.0_mm, 0.4624 }, std::pair{ 2.0_mm, 0.5757 },
      std::pair{ 4.0_mm, 0.7046 }, std::pair{ 8.0_mm, 0.9502 }, std::pair{ 12.0_mm, 1.1013 } };
    for (const auto& [x, told] : kForces)
    {
      const double wanted = told * test::kYoung / 10e3;
      EXPECT_NEAR(force(x), wanted, limit * wanted) << x << ' ' << cell;
    }
    for (double x = -4.0_mm; x < 12.0_mm; x += 0.02_mm)
    {
      const double now = force(x);
      EXPECT_NEAR(force(x + 0.02_mm), now, 0.01 * now) << x << ' ' << cell;
    }
  }
}

} // namespace
} // namespace palp
