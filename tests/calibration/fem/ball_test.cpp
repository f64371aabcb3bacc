#include "calibration/fem/indenter.h"
#include "calibration/fem/mesh.h"
#include "haptics/force/force_law.h"
#include "haptics/force/validity.h"
#include "tests/calibration/indentation_case.h"
#include "tests/support/shipped_ratios.h"

#include <algorithm>
#include <cmath>
#include <string>

// What the corrected law says of a ball of which data/reference has none, against our own elements:
// within 5 %, or flagged, however the ball is held.

namespace palp::fem
{
namespace
{

struct Pressed
{
  const char* name;
  SphereSupport support;
  StrainEnergy energy;
  bool cone;
};

class Ball : public ::testing::TestWithParam<Pressed>
{
};
INSTANTIATE_TEST_SUITE_P(OfFiftyMillimeters, Ball,
  ::testing::Values(Pressed{ "CapNH", SphereSupport::BottomCap, StrainEnergy::NeoHookean, false },
    Pressed{ "HalfNH", SphereSupport::LowerHalf, StrainEnergy::NeoHookean, false },
    Pressed{ "CapLinear", SphereSupport::BottomCap, StrainEnergy::Linear, false },
    Pressed{ "HalfLinear", SphereSupport::LowerHalf, StrainEnergy::Linear, false },
    Pressed{ "ConeCapNH", SphereSupport::BottomCap, StrainEnergy::NeoHookean, true },
    Pressed{ "ConeHalfNH", SphereSupport::LowerHalf, StrainEnergy::NeoHookean, true }),
  [](const auto& with) { return with.param.name; });

TEST_P(Ball, IsThatOfTheLawOrFlagged)
{
  const Pressed& with = GetParam();
  const double radius = 50.0_mm;
  const Material tissue{ 50.0_kPa, 0.33 };
  const Tip tip = with.cone ? cappedCone() : Tip{ SphereTip{ 10.0_mm } };
  const ForceLaw law(tip, tissue,
    { .mode = LawMode::Corrected,
      .constitution = with.energy == StrainEnergy::Linear ? ConstitutiveModel::Linear
                                                          : ConstitutiveModel::NeoHookean,
      .largeStrain = test::shippedRatios() });
  const Validity validity(law);
  const Body body = sphereBody(radius, with.support, 7.0_mm, with.cone ? 0.5_mm : 1.0_mm);
  Indenter indenter(body, tip, with.energy, tissue);
  int believed = 0;
  double worst = 0.0;
  for (ContactGeometry local{
         .depth = 0.5_mm, .thickness = 2.0 * radius, .surfaceCurvature = 1.0 / radius };
       brokenRules(validity(local)) == 0; local.depth += 0.5_mm)
  {
    indenter.press(local.depth);
    const double error = law(local).force / indenter.state().force - 1.0;
    EXPECT_LE(std::abs(error), 0.05) << local.depth;
    worst = std::max(worst, std::abs(error));
    ++believed;
  }
  EXPECT_GE(believed, 2);
  RecordProperty("believed", believed);
  RecordProperty("worst_percent", std::to_string(100.0 * worst));
}

} // namespace
} // namespace palp::fem
