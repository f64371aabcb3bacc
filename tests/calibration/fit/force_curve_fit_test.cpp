#include "calibration/fit/force_curve_fit.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace palp::fit
{
namespace
{

using namespace units::literals;

constexpr int kRepeats = 1000;

// of 1,000 trials at 0.95, four standard deviations of the binomial distribution to either side
constexpr double kCoverage = 0.95;
const double kBand = 4.0 * std::sqrt(kCoverage * (1.0 - kCoverage) / kRepeats);

// a tool as its exponent: 1 for a punch, 1.5 for a ball (Hertz), 2 for a cone (Sneddon)
struct Press
{
  double exponent;
  int rows;
  double noise;  // of the largest force
  double before; // part of the rows before the contact
};

std::ostream& operator<<(std::ostream& out, const Press& press)
{
  return out << "exponent " << press.exponent << ", " << press.rows << " rows, noise "
             << press.noise << ", before " << press.before;
}

CurveModel powerLaw(double exponent)
{
  return { .shape = [exponent](double depth, double)
    { return std::pow(depth / 5.0_mm, exponent); } };
}

constexpr double kScale = 2.0;      // [N] at 5 mm
constexpr double kContact = 1.7_mm; // of a zero that is the stage's
constexpr double kOffset = -0.05;   // [N]

Measured pressed(const Press& press, std::mt19937& random)
{
  std::normal_distribution<double> noise;
  Measured measured{ Eigen::VectorXd(press.rows), Eigen::VectorXd(press.rows) };
  for (int i = 0; i < press.rows; ++i)
  {
    const double part = (i + 0.5) / press.rows;
    const double depth = 5.0_mm * (part - press.before) / (1.0 - press.before);
    measured.depths[i] = kContact + depth;
    measured.forces[i] = kOffset +
      kScale * std::pow(std::max(0.0, depth) / 5.0_mm, press.exponent) +
      (press.noise > 0.0 ? press.noise * kScale * noise(random) : 0.0);
  }
  return measured;
}

bool covers(const Estimate& estimate, double truth)
{
  return estimate.low <= truth && truth <= estimate.high;
}

class AnyPress : public testing::TestWithParam<Press>
{
};
INSTANTIATE_TEST_SUITE_P(ForceCurveFit, AnyPress,
  testing::Values(Press{ 1.5, 40, 0.01, 0.25 }, Press{ 1.5, 40, 0.1, 0.25 },
    Press{ 1.5, 8, 0.02, 0.25 }, Press{ 1.5, 25, 0.02, 0.0 }, Press{ 2.0, 100, 0.05, 0.4 },
    Press{ 2.0, 12, 0.01, 0.3 }, Press{ 1.0, 30, 0.03, 0.3 }, Press{ 1.0, 10, 0.005, 0.3 }));

TEST_P(AnyPress, IsCoveredByItsIntervalsInNineteenTrialsOfTwenty)
{
  std::mt19937 random(11);
  int scales = 0;
  int contacts = 0;
  for (int trial = 0; trial < kRepeats; ++trial)
  {
    const CurveFit fit = fitForceCurve(pressed(GetParam(), random), powerLaw(GetParam().exponent));
    scales += covers(fit.scale, kScale) ? 1 : 0;
    contacts += covers(fit.contact, kContact) ? 1 : 0;
  }
  RecordProperty("scales", scales);
  EXPECT_NEAR(static_cast<double>(scales) / kRepeats, kCoverage, kBand);
  EXPECT_NEAR(static_cast<double>(contacts) / kRepeats, kCoverage, kBand);
}

TEST_P(AnyPress, IsFoundToSixDigitsWithoutNoise)
{
  Press press = GetParam();
  press.noise = 0.0;
  std::mt19937 random;
  const CurveFit fit = fitForceCurve(pressed(press, random), powerLaw(press.exponent));
  EXPECT_NEAR(fit.scale.value, kScale, 1e-6 * kScale);
  EXPECT_NEAR(fit.contact.value, kContact, 1e-6 * 5.0_mm);
  EXPECT_NEAR(fit.offset, kOffset, 1e-6 * kScale);
  EXPECT_TRUE(covers(fit.scale, kScale))
    << fit.scale.low - kScale << ' ' << fit.scale.high - kScale;
}

// steeper than the curve from the first exponent that is searched, which fits best
TEST(ForceCurveFit, TheEndOfWhatIsSearchedIsNoEndOfAnInterval)
{
  std::mt19937 random(3);
  CurveModel steep;
  steep.shape = [](double depth, double exponent) { return std::pow(depth / 5.0_mm, exponent); };
  steep.extra = { 1.4, 3.0 };
  steep.contact = kContact;
  const CurveFit fit = fitForceCurve(pressed({ 1.0, 30, 0.03, 0.3 }, random), steep);
  EXPECT_EQ(fit.extra.value, 1.4);
  EXPECT_TRUE(std::isinf(fit.extra.low) && fit.extra.low < 0.0) << fit.extra.low;
  EXPECT_LT(fit.extra.high, 3.0);
  EXPECT_GE(fit.scale.high, fit.scale.value);
}

// so few rows, so much noise, that for some the straight line through them explains as much
TEST(ForceCurveFit, AScaleThatTheCurveDoesNotTellHasNoEnd)
{
  std::mt19937 random(11);
  int unknown = 0;
  for (int trial = 0; trial < kRepeats; ++trial)
  {
    const CurveFit fit = fitForceCurve(pressed({ 1.5, 15, 0.1, 0.12 }, random), powerLaw(1.5));
    const bool isUnknown = std::isinf(fit.scale.low) && fit.scale.low < 0.0;
    EXPECT_TRUE(isUnknown || fit.scale.low > 0.0) << fit.scale.low;
    EXPECT_TRUE(!isUnknown || (std::isinf(fit.contact.low) && fit.contact.low < 0.0));
    unknown += isUnknown ? 1 : 0;
  }
  EXPECT_GT(unknown, 0);
  EXPECT_LT(unknown, kRepeats / 2);
}

} // namespace
} // namespace palp::fit
