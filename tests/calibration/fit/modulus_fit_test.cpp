#include "calibration/fit/modulus_fit.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace palp::fit
{
namespace
{

using namespace units::literals;

constexpr double kYoung = 8.0_kPa;
constexpr double kPoisson = 0.45;
constexpr double kContactModulus = kYoung / (1.0 - kPoisson * kPoisson);
constexpr double kTouched = -1.5_mm;

ModulusQuestion question(const Tip& tip, LawMode mode = LawMode::Paper)
{
  return { .tip = tip,
    .poissonRatio = kPoisson,
    .settings = { .mode = mode, .constitution = ConstitutiveModel::Linear } };
}

// 2 mm in the air, 6 mm in the tissue
template <typename Law>
Measured pressed(const Law& force, int rows, double noise = 0.0, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 1.0);
  Measured measured{ Eigen::VectorXd(rows), Eigen::VectorXd(rows) };
  for (int i = 0; i < rows; ++i)
  {
    const double depth = -2.0_mm + 8.0_mm * i / (rows - 1);
    measured.depths[i] = kTouched + depth;
    measured.forces[i] = force(std::max(0.0, depth)) + noise * error(random);
  }
  return measured;
}

double hertz(double depth)
{
  return 4.0 / 3.0 * kContactModulus * std::sqrt(4.0_mm * depth) * depth;
}

double sneddonsCone(double depth)
{
  return 2.0 / std::numbers::pi * kContactModulus * std::tan(30.0_deg) * depth * depth;
}

double flatPunch(double depth)
{
  return 2.0 * kContactModulus * 3.0_mm * depth;
}

struct Known
{
  const char* name;
  Tip tip;
  double (*force)(double depth);
  double exponent;
};

const std::array kKnown{ Known{ "ball", SphereTip{ 4.0_mm }, hertz, 1.5 },
  Known{ "cone", ConeTip{ 30.0_deg, 20.0_mm }, sneddonsCone, 2.0 },
  Known{ "punch", PunchTip{ 3.0_mm }, flatPunch, 1.0 } };

TEST(ModulusFit, FindsTheModulusOfPublishedLaws)
{
  for (const Known& known : kKnown)
  {
    const ModulusFit fit = fitModulus(pressed(known.force, 33), question(known.tip));
    EXPECT_NEAR(fit.asked().curve.scale.value, kYoung, 1e-6 * kYoung) << known.name;
    EXPECT_NEAR(fit.asked().curve.contact.value, kTouched, 1e-6_mm) << known.name;
    ASSERT_NE(fit.exponent(), nullptr);
    EXPECT_NEAR(fit.exponent()->value, known.exponent, 1e-5) << known.name;
    EXPECT_EQ(fit.best, fit.answer) << known.name;
    EXPECT_FALSE(fit.isSystematic);
  }
}

// the closed form of the ball beyond Hertz, by its radius of contact
TEST(ModulusFit, TellsWhichLawExplainsACurve)
{
  const double radius = 4.0_mm;
  Measured exact{ Eigen::VectorXd(30), Eigen::VectorXd(30) };
  for (int i = 0; i < 30; ++i)
  {
    const double a = radius * (0.1 + 0.8 * i / 29.0);
    const double log = std::log((radius + a) / (radius - a));
    exact.depths[i] = 0.5 * a * log;
    exact.forces[i] = kContactModulus * (0.5 * (a * a + radius * radius) * log - a * radius);
  }
  const ModulusFit fit = fitModulus(exact, question(SphereTip{ radius }));
  EXPECT_EQ(fit.asked().name, "paper");
  EXPECT_EQ(fit.laws[fit.best].name, "exact");
  EXPECT_NEAR(fit.laws[fit.best].curve.scale.value, kYoung, 1e-5 * kYoung);
  EXPECT_LT(fit.asked().weight, 1e-6);
  EXPECT_TRUE(fit.isSystematic); // the paper's leaves a curve, no noise
}

TEST(ModulusFit, CountsAParameterAgainstALaw)
{
  const Measured measured = pressed(hertz, 40, 1e-3);
  const ModulusFit fit = fitModulus(measured, question(SphereTip{ 4.0_mm }));
  for (const LawFit& law : fit.laws)
  {
    const double squares = (measured.forces - law.curve.forces).squaredNorm();
    const double parameters = law.name == "power" ? 4.0 : 3.0; // E, contact, offset, exponent
    EXPECT_NEAR(law.aic, 40.0 * std::log(squares / 40.0) + 2.0 * (parameters + 1.0), 1e-9);
  }
  EXPECT_FALSE(fit.isSystematic);
}

// presses of a ball with noise; four deviations of the binomial distribution
TEST(ModulusFit, CoversModulusAndExponentInNineteenTrialsOfTwenty)
{
  constexpr int kTrials = 300;
  const double band = 4.0 * std::sqrt(0.95 * 0.05 / kTrials);
  int moduli = 0;
  int exponents = 0;
  for (unsigned trial = 0; trial < kTrials; ++trial)
  {
    const ModulusFit fit =
      fitModulus(pressed(hertz, 24, 2e-3, trial), question(SphereTip{ 4.0_mm }));
    const Estimate& young = fit.asked().curve.scale;
    moduli += young.low <= kYoung && kYoung <= young.high ? 1 : 0;
    exponents += fit.exponent()->low <= 1.5 && 1.5 <= fit.exponent()->high ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(moduli) / kTrials, 0.95, band);
  EXPECT_NEAR(static_cast<double>(exponents) / kTrials, 0.95, band);
}

Measured reference(const std::string& file, const char* column)
{
  const NumberTable table =
    NumberTable::readColumns(std::filesystem::path(PALP_SOURCE_DIR) / "data/reference" / file,
      std::array{ "delta_m", column });
  const auto rows = static_cast<Eigen::Index>(table.rows.size());
  Measured measured{ Eigen::VectorXd(rows), Eigen::VectorXd(rows) };
  for (Eigen::Index i = 0; i < rows; ++i)
  {
    measured.depths[i] = table.rows[static_cast<std::size_t>(i)].values[0];
    measured.forces[i] = table.rows[static_cast<std::size_t>(i)].values[1];
  }
  return measured;
}

// a bonded layer of 30 mm, 50 kPa, by another program
TEST(ModulusFit, FindsTheThicknessOfALayer)
{
  ModulusQuestion asked{ .tip = SphereTip{ 6.0_mm },
    .poissonRatio = 0.33,
    .settings = { .mode = LawMode::Corrected, .constitution = ConstitutiveModel::Linear },
    .searchThickness = true };
  const Measured layer = reference("analytic_sphere_R6_H30.csv", "F_layer_N");
  const ModulusFit fit = fitModulus(layer, asked);
  ASSERT_TRUE(fit.thickness());
  EXPECT_NEAR(fit.thickness()->value, 30.0_mm, 0.1_mm);
  EXPECT_NEAR(fit.asked().curve.scale.value, 50.0_kPa, 1e-3 * 50.0_kPa);
  EXPECT_EQ(fit.best, fit.answer);

  asked.searchThickness = false;
  asked.place.thickness = 30.0_mm;
  const ModulusFit known = fitModulus(layer, asked);
  EXPECT_FALSE(known.thickness());
  EXPECT_NEAR(known.asked().curve.scale.value, 50.0_kPa, 1e-5 * 50.0_kPa);
}

// so noisy that a body hardly thicker than the press is deep may fit better, and one thinner still
// where the law goes on as lines
TEST(ModulusFit, OfALayerInNoiseHoldsEveryThicknessThatItAllows)
{
  constexpr double kThickness = 12.0_mm;
  constexpr int kTrials = 24;
  constexpr double kDeepest = 6.0_mm;
  ModulusQuestion asked = question(SphereTip{ 10.0_mm }, LawMode::Corrected);
  const ForceLaw law(asked.tip, { kYoung, kPoisson }, asked.settings);
  const auto layer = [&](double depth)
  { return law({ .depth = depth, .thickness = kThickness }).force; };
  asked.searchThickness = true;
  int moduli = 0;
  int thicknesses = 0;
  for (unsigned trial = 0; trial < kTrials; ++trial)
  {
    const ModulusFit fit = fitModulus(pressed(layer, 60, 6e-3 * layer(kDeepest), trial), asked);
    const Estimate& young = fit.asked().curve.scale;
    const Estimate thickness = fit.thickness().value();
    EXPECT_GT(thickness.value, 0.8 * kDeepest) << trial;
    moduli += young.low <= kYoung && kYoung <= young.high ? 1 : 0;
    thicknesses += thickness.low <= kThickness && kThickness <= thickness.high ? 1 : 0;
  }
  EXPECT_GE(moduli, kTrials - 4); // fewer: one time in 200
  EXPECT_GE(thicknesses, kTrials - 4);
}

// a flat punch tells none: a line is a line
TEST(ModulusFit, OfAHalfSpaceLeavesTheThicknessOpen)
{
  ModulusQuestion asked = question(PunchTip{ 3.0_mm }, LawMode::Corrected);
  asked.searchThickness = true;
  constexpr int kTrials = 20;
  int covered = 0;
  for (unsigned trial = 1; trial <= kTrials; ++trial)
  {
    const ModulusFit fit = fitModulus(pressed(flatPunch, 30, 3e-3, trial), asked);
    ASSERT_TRUE(fit.thickness());
    EXPECT_TRUE(std::isinf(fit.thickness()->high)) << trial;
    const Estimate& young = fit.asked().curve.scale;
    EXPECT_LT(young.low, 0.9 * kYoung) << trial;
    covered += young.low <= kYoung && kYoung <= young.high ? 1 : 0;
  }
  EXPECT_GE(covered, kTrials - 4); // fewer: one time in 400
}

TEST(ModulusFit, OfARisingCurveInContactTellsNoContactOfAPunch)
{
  // a line is a line wherever it begins; its slope is the modulus all the same
  Measured line = pressed(flatPunch, 33);
  line = { line.depths.tail(20), line.forces.tail(20) };
  line.forces[3] += 1e-3;
  const ModulusFit fit = fitModulus(line, question(PunchTip{ 3.0_mm }));
  EXPECT_TRUE(std::isinf(fit.asked().curve.contact.low));
  EXPECT_NEAR(fit.asked().curve.scale.value, kYoung, 0.01 * kYoung);
  EXPECT_GT(fit.asked().curve.scale.low, 0.5 * kYoung);
  EXPECT_LT(fit.asked().curve.scale.high, 1.5 * kYoung);
}

TEST(ModulusFit, HoldsWhatIsKnown)
{
  ModulusQuestion asked = question(SphereTip{ 4.0_mm });
  const Measured measured = pressed(hertz, 30, 5e-3);
  const Estimate free = fitModulus(measured, asked).asked().curve.scale;
  asked.contact = kTouched;
  asked.offset = 0.0;
  const ModulusFit fit = fitModulus(measured, asked);
  EXPECT_EQ(fit.asked().curve.contact.value, kTouched);
  EXPECT_EQ(fit.asked().curve.offset, 0.0);
  const Estimate held = fit.asked().curve.scale;
  EXPECT_LT(held.high - held.low, 0.6 * (free.high - free.low));
  // linear least squares of one parameter: E s / sqrt(sum of squares of the law)
  const Eigen::VectorXd law = fit.asked().curve.forces / held.value;
  const double deviation =
    std::sqrt((measured.forces - fit.asked().curve.forces).squaredNorm() / 29.0) / law.norm();
  EXPECT_NEAR(held.high - held.value, 2.045 * deviation, 1e-3 * deviation); // t of 29 degrees
  EXPECT_NEAR(held.value - held.low, 2.045 * deviation, 1e-3 * deviation);
}

TEST(ModulusFit, RefusesWhatIsNoPress)
{
  const auto ask = question(SphereTip{ 4.0_mm });
  Measured pulled = pressed(hertz, 20);
  pulled.forces *= -1.0;
  EXPECT_THROW((void)fitModulus(pulled, ask), Error);
  Measured falling = pressed(hertz, 20);
  falling.forces.reverseInPlace();
  EXPECT_THROW((void)fitModulus(falling, ask), Error);
  EXPECT_THROW((void)fitModulus(pressed(hertz, 3), ask), Error);
}

} // namespace
} // namespace palp::fit
