#include "calibration/fem/indenter.h"

#include "calibration/fem/mesh.h"
#include "haptics/error.h"
#include "tests/calibration/indentation_case.h"

#include <array>
#include <numbers>

namespace palp::fem
{
namespace
{

using namespace units::literals;

// far from every boundary the linear body is Hertz's half-space
TEST(Indenter, LargeLinearBlockIsHertzsHalfSpace)
{
  const Case study{ .name = "half-space",
    .width = 600.0_mm,
    .length = 600.0_mm,
    .height = 300.0_mm,
    .tip = ParaboloidTip{ 10.0_mm },
    .energy = StrainEnergy::Linear,
    .depths = { 0.5_mm, 1.0_mm, 2.0_mm },
    .elementSize = 0.25_mm };
  for (const IndentationStep& step : completed(study).steps)
  {
    const double hertz = hertzForce(study, 10.0_mm, step.depth);
    EXPECT_NEAR(step.force, hertz, 0.02 * hertz);
    EXPECT_NEAR(step.contactRadius, std::sqrt(10.0_mm * step.depth), 0.25_mm);
  }
}

TEST(Indenter, HalvingTheMeshChangesTheForceByLessThanTwoPercent)
{
  for (const Case& coarse : { paperCase(StrainEnergy::Linear), paperCase() })
  {
    Case fine = coarse;
    fine.elementSize = 0.5 * coarse.elementSize;
    const auto before = completed(coarse).steps;
    const auto after = completed(fine).steps;
    for (std::size_t i = 1; i < before.size(); ++i)
    {
      EXPECT_NEAR(before[i].force, after[i].force, 0.01 * after[i].force) << i;
    }
  }
}

// nothing but Young's modulus sets the scale of stress: F follows it, shapes do not
TEST(Indenter, ForceFollowsYoungsModulusAndTheExtentDoesNot)
{
  for (const StrainEnergy energy : { StrainEnergy::NeoHookean, StrainEnergy::Corotated })
  {
    Case soft = paperCase(energy);
    Case stiff = soft;
    stiff.material.youngModulus = 1.5_MPa;
    const auto a = completed(soft).steps;
    const auto b = completed(stiff).steps;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      EXPECT_NEAR(b[i].force, 30.0 * a[i].force, 1e-5 * b[i].force);
      EXPECT_NEAR(extentRadius(b[i].profile, 0.5_mm), extentRadius(a[i].profile, 0.5_mm), 1e-7);
    }
  }
}

// a wide linear layer under a paraboloid against its series
void expectLayer(double poisson, Base base, double m0, double m2, double tolerance)
{
  Case study = paperCase(StrainEnergy::Linear);
  study.material.poissonRatio = poisson;
  study.base = base;
  study.tip = ParaboloidTip{ 10.0_mm };
  study.width = study.length = 300.0_mm;
  study.depths = { 1.0_mm, 2.0_mm };
  study.elementSize = 0.5_mm;
  for (const IndentationStep& step : completed(study).steps)
  {
    const double hertz = hertzForce(study, 10.0_mm, step.depth);
    const double chi = std::sqrt(10.0_mm * step.depth) / 50.0_mm;
    EXPECT_NEAR(step.force, layerFactor(chi, m0, m2) * hertz, tolerance * hertz);
  }
}

// as nu grows towards 0.5 the exact layer stiffens smoothly; an element that locks does not follow
TEST(Indenter, NearlyIncompressibleTissueDoesNotLock)
{
  expectLayer(0.49, Base::Bonded, 1.73745, 3.72071, 0.02);
}

// of a neo-Hookean half-space by an independent program at nu = 0.495, which scatters by 1.5 %; the
// base at ten times the depth of the contact adds 1 %
TEST(Indenter, TissueLikeWaterIsTheIncompressibleHalfSpace)
{
  const Case study{ .name = "water",
    .width = 500.0_mm,
    .length = 500.0_mm,
    .height = 500.0_mm,
    .tip = SphereTip{ 10.0_mm },
    .material = { 50.0_kPa, 0.4999 },
    .depths = { 1.0_mm, 3.0_mm },
    .elementSize = 1.0_mm };
  const auto steps = completed(study).steps;
  constexpr std::array kOfHertz{ 0.2727286 / 0.2792391, 1.359243 / 1.450969 };
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const double hertz = hertzForce(study, 10.0_mm, steps[i].depth);
    EXPECT_NEAR(steps[i].force / hertz, kOfHertz[i], 0.02) << steps[i].depth;
    EXPECT_NEAR(steps[i].baseReaction, steps[i].force, 1e-6 * steps[i].force);
  }
}

// what cannot be solved without a fold is not solved: four points in an element let it fold by
// 0.2 mm under a cone of 45 degrees
TEST(Indenter, StopsWhereTheSurfaceWouldFold)
{
  const Body body = cylinderBody(25.0_mm, 20.0_mm, 4.0_mm, 0.25_mm, {}, Integration::Reduced);
  Indenter indenter(body, cappedCone(), StrainEnergy::NeoHookean, { 50.0_kPa, 0.33 });
  std::string why;
  try
  {
    for (const double depth : { 1.0_mm, 2.0_mm, 3.0_mm, 4.0_mm, 5.0_mm })
    {
      indenter.press(depth);
    }
  }
  catch (const Error& error)
  {
    why = error.what();
  }
  EXPECT_NE(why.find("the surface folds over"), std::string::npos) << why;
  EXPECT_LT(indenter.checkpoint().depth, 5.0_mm);
  const auto profile = indenter.state().profile; // the last solution has none
  for (std::size_t i = 1; i < profile.size(); ++i)
  {
    EXPECT_GT(profile[i].radius + profile[i].ur, profile[i - 1].radius + profile[i - 1].ur);
  }
}

// Lebedev's layer on a slipping base has the same integrals for every nu
TEST(Indenter, ASlippingBaseIsSofterAsTheLayerSays)
{
  expectLayer(0.33, Base::Slip, 1.16758, 1.58153, 0.01);
}

// 2 E* a d, and the layer's series 1 + 2 m0 a / (pi h) + ...: m0 = 1.41177 at nu = 0.33
TEST(Indenter, AFlatPunchIsTheExactOne)
{
  Case study = paperCase(StrainEnergy::Linear);
  study.tip = PunchTip{ 5.0_mm };
  study.depths = depthRange(1.0_mm, 5.0_mm, 1.0_mm);
  study.width = study.length = 150.0_mm;
  study.elementSize = 0.5_mm;
  const double layer = 1.0 / (1.0 - 2.0 / std::numbers::pi * 1.41177 * 5.0 / 50.0);
  for (const IndentationStep& step : completed(study).steps)
  {
    const double exact = 2.0 * study.material.contactModulus() * 5.0_mm * step.depth * layer;
    EXPECT_NEAR(step.force, exact, 0.02 * exact) << step.depth;
  }
}

// large strain, with a round edge: the pressure on it is finite and all depths are found. At small
// strain it is the linear punch less what the edge takes
TEST(Indenter, AFlatPunchGoesAsDeepAsItIsWide)
{
  Case study = paperCase();
  study.tip = withCap(PunchTip{ 5.0_mm }, 0.3_mm);
  study.depths = { 0.3_mm, 2.5_mm, 5.0_mm };
  study.elementSize = 0.5_mm;
  const auto steps = completed(study).steps;
  const double layer = 1.0 / (1.0 - 2.0 / std::numbers::pi * 1.41177 * 4.7 / 50.0);
  const double smallest = 2.0 * study.material.contactModulus() * 4.7_mm * 0.3_mm * layer;
  EXPECT_GT(steps[0].force, 0.97 * smallest);
  EXPECT_LT(steps[0].force, 1.03 * smallest * 5.0 / 4.7);
  for (const IndentationStep& step : steps)
  {
    EXPECT_NEAR(step.baseReaction, step.force, 1e-4 * step.force);
    EXPECT_LE(step.penetration, 1e-3 * step.depth);
    EXPECT_NEAR(step.contactRadius, 5.0_mm, 0.5_mm);
  }
}

// a cone deeper than it is long: the surface would have to fold around a sharp edge
TEST(Indenter, SaysThatTheContactReachedTheRim)
{
  Case study = paperCase(StrainEnergy::NeoHookeanIsochoric);
  study.tip = BluntConeTip{ .halfAngle = 60.0_deg, .tipRadius = 0.3_mm, .baseRadius = 2.0_mm };
  study.width = study.length = 20.0_mm;
  study.height = 8.0_mm;
  study.elementSize = 0.5_mm;
  study.depths = { 1.0_mm, 3.0_mm };
  const Outcome outcome = calibrate(study);
  EXPECT_EQ(outcome.steps.size(), 1U);
  EXPECT_NE(outcome.error.find("rim"), std::string::npos) << outcome.error;
}

} // namespace
} // namespace palp::fem
