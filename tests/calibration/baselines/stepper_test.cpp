#include "calibration/baselines/stepper.h"

#include "calibration/fem/indenter.h"
#include "calibration/fem/mesh.h"
#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace palp::fem
{
namespace
{

using namespace units::literals;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr Material kTissue{ 50.0_kPa, 0.33 };
constexpr StepSettings kExact{ .mostIterations = 2000, .tolerance = 1e-12 };

// 60 x 60 x 30 mm under a sphere of 10 mm
Stepper smallBlock(Baseline baseline, const Material& tissue = kTissue,
  const StepSettings& settings = {}, int n = 11)
{
  return Stepper(
    blockTets(60.0_mm, 30.0_mm, n, (n + 1) / 2), baseline, SphereTip{ 10.0_mm }, tissue, settings);
}

VectorXd lumpedMasses(const TetMesh& mesh, double density)
{
  VectorXd masses = VectorXd::Zero(mesh.positions.cols());
  for (const auto& tet : mesh.tets)
  {
    for (const int i : tet)
    {
      masses[i] += 0.25 * density * volume(mesh.positions, tet);
    }
  }
  return masses;
}

class AnyBaseline : public testing::TestWithParam<Baseline>
{
};
INSTANTIATE_TEST_SUITE_P(Stepper, AnyBaseline, testing::ValuesIn(kBaselines),
  [](const auto& at)
  {
    std::string text(name(at.param));
    std::erase(text, '-');
    return text;
  });

TEST_P(AnyBaseline, WithoutToolNothingMoves)
{
  Stepper stepper = smallBlock(GetParam());
  const StepOutcome outcome = stepper.step(10.0_ms);
  EXPECT_EQ(outcome.force, 0.0);
  EXPECT_EQ(outcome.touching, 0);
  EXPECT_LT((stepper.positions() - stepper.mesh().positions).lpNorm<Eigen::Infinity>(), 1e-15);
}

TEST_P(AnyBaseline, AtRestTheBaseCarriesTheForceAndNoNodeIsInTheTool)
{
  Stepper stepper = smallBlock(GetParam());
  const double depth = 3.0_mm;
  stepper.placeTool({ 1.0_mm, -2.0_mm, -depth });
  const StepOutcome outcome = settle(stepper, 10.0_ms);
  EXPECT_GT(outcome.force, 0.0);
  EXPECT_NEAR(outcome.baseReaction, outcome.force, 1e-4 * outcome.force);
  EXPECT_LT(outcome.kineticEnergy, 1e-9 * outcome.elasticEnergy);
  int onTool = 0;
  for (const int i : stepper.mesh().surface)
  {
    const Vector3d at = stepper.positions().col(i) - Vector3d(1.0_mm, -2.0_mm, 10.0_mm - depth);
    EXPECT_GT(at.norm(), 10.0_mm - 1e-8) << i;
    onTool += at.norm() < 10.0_mm + 1e-8 ? 1 : 0;
  }
  EXPECT_EQ(onTool, outcome.touching);
}

// pressed, slid, and lifted faster than the body follows: the tool pushes or lets go
TEST_P(AnyBaseline, TheToolNeverPulls)
{
  Stepper stepper = smallBlock(GetParam());
  double most = 0.0;
  for (int k = 1; k <= 30; ++k)
  {
    stepper.placeTool({ std::max(0, k - 10) * 0.5_mm, 0.0, std::max(-3.0_mm, -0.3_mm * k) });
    const double force = stepper.step(5.0_ms).force;
    most = std::max(most, force);
    EXPECT_GT(force, 0.0) << k;
  }
  stepper.placeTool({ 10.0_mm, 0.0, 5.0_mm });
  const StepOutcome lifted = stepper.step(5.0_ms);
  EXPECT_EQ(lifted.touching, 0);
  EXPECT_EQ(lifted.force, 0.0);
  EXPECT_LT(stepper.positions().row(2).maxCoeff(), 1.0_mm);

  stepper.placeTool({ 10.0_mm, 0.0, -3.0_mm }); // and down again at once
  (void)stepper.step(5.0_ms);
  for (const double height : { -2.9_mm, -2.0_mm, -1.0_mm })
  {
    stepper.placeTool({ 10.0_mm, 0.0, height });
    EXPECT_GT(stepper.step(5.0_ms).force, -0.01 * most) << height;
  }
}

// momentum changes by what the tool and the base give, step by step
TEST_P(AnyBaseline, MomentumIsThatOfTheForces)
{
  Stepper stepper = smallBlock(GetParam(), kTissue, kExact);
  const VectorXd masses = lumpedMasses(stepper.mesh(), kExact.density);
  double before = 0.0;
  for (int k = 1; k <= 10; ++k)
  {
    stepper.placeTool({ 0.0, 0.0, -0.3_mm * k });
    const StepOutcome outcome = stepper.step(2.0_ms);
    const double now = stepper.velocities().row(2).dot(masses);
    EXPECT_NEAR((now - before) / 2.0_ms, outcome.baseReaction - outcome.force,
      1e-8 * std::abs(outcome.force));
    before = now;
  }
}

TEST_P(AnyBaseline, ReleasedItLosesEnergyUntilItRests)
{
  Stepper stepper = smallBlock(GetParam(), kTissue, { .mostIterations = 200, .tolerance = 1e-10 });
  stepper.placeTool({ 0.0, 0.0, -3.0_mm });
  const double stored = settle(stepper, 10.0_ms).elasticEnergy;
  stepper.removeTool();
  double before = stored;
  double kinetic = 0.0;
  double energy = stored;
  for (int k = 0; k < 150; ++k)
  {
    const StepOutcome outcome = stepper.step(1.0_ms);
    energy = outcome.elasticEnergy + kinetic; // both before this step
    EXPECT_LE(energy, before + 1e-12 * stored) << k;
    before = energy;
    kinetic = outcome.kineticEnergy;
    EXPECT_EQ(outcome.force, 0.0);
  }
  EXPECT_LT(energy, 1e-3 * stored);
}

TEST_P(AnyBaseline, ConjugateGradientsKeepTheirToleranceOrTheirLimit)
{
  for (const int most : { 5, 25, 1000 })
  {
    const StepSettings settings{ .mostIterations = most, .tolerance = 1e-6 };
    Stepper stepper = smallBlock(GetParam(), kTissue, settings);
    for (int k = 1; k <= 5; ++k)
    {
      stepper.placeTool({ 0.0, 0.0, -0.5_mm * k });
      const StepOutcome outcome = stepper.step(10.0_ms);
      EXPECT_LE(outcome.iterations, most);
      EXPECT_TRUE(outcome.residual <= settings.tolerance || outcome.iterations == most);
      EXPECT_TRUE(most < 1000 || outcome.residual <= settings.tolerance);
    }
  }
}

// statics do not know the modulus but as a factor; soft to stiff, slow to fast, to nearly no change
// of volume
TEST_P(AnyBaseline, ForcesAtRestScaleWithTheModulusAtEveryTimeStep)
{
  const double nu = 0.49;
  std::vector<double> perModulus;
  for (const double young : { 1.0_kPa, 50.0_kPa, 1.5_MPa })
  {
    for (const double dt : { 1.0_ms, 20.0_ms })
    {
      Stepper stepper = smallBlock(
        GetParam(), { young, nu }, { .mostIterations = 100, .stiffnessDamping = 20.0_ms });
      stepper.placeTool({ 0.0, 0.0, -2.0_mm }); // all at once
      perModulus.push_back(settle(stepper, dt, 1e-4, 3000).force / young);
    }
  }
  for (const double value : perModulus)
  {
    EXPECT_NEAR(value, perModulus.front(), 5e-3 * perModulus.front());
  }
}

TEST_P(AnyBaseline, ResetBringsTheSameMotionAgain)
{
  Stepper stepper = smallBlock(GetParam());
  const auto press = [&]
  {
    const auto path = pressPath(3.0_mm, 0.1, 20.0_ms, 5.0_ms);
    std::vector<double> forces;
    for (const StepOutcome& outcome : timeSteps(stepper, path, 5.0_ms).outcomes)
    {
      forces.push_back(outcome.force);
    }
    return forces;
  };
  const auto first = press();
  stepper.reset();
  EXPECT_EQ(press(), first);
}

// to the static elements of this project: eight nodes, exact contact, another solver. The block is
// their cylinder of equal area, which is 0.5 % off
TEST(Stepper, CorotationalForceTendsToThatOfTheStaticElements)
{
  const double depth = 2.0_mm;
  const Body body = cylinderBody(60.0_mm / std::sqrt(std::numbers::pi), 30.0_mm, 15.0_mm, 1.0_mm);
  Indenter indenter(body, SphereTip{ 10.0_mm }, StrainEnergy::Corotated, kTissue);
  indenter.press(depth);
  const double exact = indenter.state().force;
  double error = 2.0;
  for (const int n : { 7, 13, 25 })
  {
    Stepper stepper = smallBlock(Baseline::Corotational, kTissue, { .mostIterations = 200 }, n);
    (void)timeSteps(stepper, pressPath(depth, 0.02, 0.0, 20.0_ms), 20.0_ms);
    const double now = std::abs(settle(stepper, 20.0_ms, 1e-4).force / exact - 1.0);
    EXPECT_LT(now, 0.5 * error) << n;
    error = now;
  }
  EXPECT_LT(error, 0.03);
}

// springs have directions and elements have not: they agree in the mean only
TEST(Stepper, SpringsThatHoldVolumesStayNearTheElements)
{
  const auto force = [](Baseline baseline)
  {
    Stepper stepper = smallBlock(baseline, kTissue, { .mostIterations = 200 }, 17);
    (void)timeSteps(stepper, pressPath(5.0_mm, 0.05, 0.0, 10.0_ms), 10.0_ms);
    const double settled = settle(stepper, 20.0_ms, 1e-4).force;
    EXPECT_EQ(invertedElements(stepper.mesh(), stepper.positions()), 0);
    return settled;
  };
  const double elements = force(Baseline::Corotational);
  EXPECT_NEAR(force(Baseline::MassSpringVolume), elements, 0.2 * elements);
}

// the motion at a given time converges with the time step, in the first order of backward Euler
TEST_P(AnyBaseline, HalvingTheTimeStepHalvesTheError)
{
  const auto released = [&](double dt)
  {
    Stepper stepper =
      smallBlock(GetParam(), kTissue, { .mostIterations = 500, .tolerance = 1e-10 }, 7);
    stepper.placeTool({ 0.0, 0.0, -2.0_mm });
    (void)settle(stepper, 10.0_ms, 1e-7);
    stepper.removeTool();
    for (double t = 0.0; t < 8.0_ms - 0.5 * dt; t += dt)
    {
      (void)stepper.step(dt);
    }
    return Matrix3Xd(stepper.positions());
  };
  const Matrix3Xd a = released(0.5_ms);
  const Matrix3Xd b = released(0.25_ms);
  const Matrix3Xd c = released(0.125_ms);
  const double ratio = (a - b).norm() / (b - c).norm();
  EXPECT_GT(ratio, 1.6);
  EXPECT_LT(ratio, 2.4);
}

template <typename Work>
std::string refusal(const Work& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

TEST(Stepper, BadInputIsRefusedInOneSentence)
{
  Stepper stepper = smallBlock(Baseline::Corotational, kTissue, {}, 5);
  for (const double dt : { 0.0, -1.0_ms, 2.0, static_cast<double>(NAN) })
  {
    EXPECT_NE(refusal([&] { (void)stepper.step(dt); }).find("time step"), std::string::npos) << dt;
  }
  EXPECT_NE(refusal(
              [&] {
                stepper.placeTool({ 31.0_mm, 0.0, 0.0 });
              })
              .find("beside"),
    std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                stepper.placeTool({ 0.0, 0.0, -31.0_mm });
              })
              .find("below"),
    std::string::npos);
  EXPECT_NE(refusal(
              [&] {
                stepper.placeTool({ 0.0, NAN, 0.0 });
              })
              .find("finite"),
    std::string::npos);
  EXPECT_NE(refusal(
              [] {
                (void)smallBlock(Baseline::Corotational, { 50.0_kPa, 0.5 }, {}, 5);
              })
              .find("0.49"),
    std::string::npos);
  EXPECT_NE(refusal(
              [] {
                (void)smallBlock(Baseline::MassSpringVolume, { 50.0_kPa, 0.2 }, {}, 5);
              })
              .find("0.25"),
    std::string::npos);
  EXPECT_NE(refusal([] { (void)smallBlock(Baseline::MassSpring, { -1.0, 0.3 }, {}, 5); }), "");
  EXPECT_NE(
    refusal([] { (void)smallBlock(Baseline::MassSpring, kTissue, { .mostIterations = 0 }, 5); }),
    "");
  EXPECT_NE(
    refusal([] { (void)smallBlock(Baseline::MassSpring, kTissue, { .density = NAN }, 5); }), "");
  EXPECT_NE(refusal([&] { (void)timeSteps(stepper, {}, 1.0_ms); }), "");
  EXPECT_NE(refusal([] { (void)pressPath(1.0_mm, 0.0, 0.0, 1.0_ms); }), "");

  TetMesh loose = blockTets(60.0_mm, 30.0_mm, 5, 3);
  loose.bonded.clear();
  EXPECT_NE(
    refusal([&] { const Stepper s(loose, Baseline::MassSpring, SphereTip{ 10.0_mm }, kTissue); })
      .find("no bonded"),
    std::string::npos);
}

// the time for work, in the middle of a run that was not disturbed by what went wrong before
TEST(Stepper, GoesOnAfterARefusal)
{
  Stepper stepper = smallBlock(Baseline::Corotational, kTissue, {}, 5);
  stepper.placeTool({ 0.0, 0.0, -1.0_mm });
  const double force = settle(stepper, 10.0_ms).force;
  EXPECT_THROW((void)stepper.step(-1.0), Error);
  EXPECT_THROW(stepper.placeTool({ 1.0, 0.0, 0.0 }), Error);
  EXPECT_NEAR(stepper.step(10.0_ms).force, force, 1e-4 * force);
}

} // namespace
} // namespace palp::fem
