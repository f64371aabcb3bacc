#include "haptics/servo/coupling.h"

#include "haptics/units.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// F = c d^n: a cone (2), a sphere (1.5), a punch (1)
struct PowerLaw
{
  double factor;
  double exponent;

  Response operator()(double depth) const noexcept
  {
    return depth > 0.0 ? Response{ .force = factor * std::pow(depth, exponent),
      .stiffness = factor * exponent * std::pow(depth, exponent - 1.0) }
                       : Response{};
  }
};

constexpr auto kRigid = [](double depth) noexcept
{ return depth > 0.0 ? Response{ .force = kInf, .stiffness = kInf } : Response{}; };

class AnyLaw : public ::testing::TestWithParam<PowerLaw>
{
};
INSTANTIATE_TEST_SUITE_P(Coupling, AnyLaw,
  ::testing::Values(PowerLaw{ 7.48e3, 1.5 }, PowerLaw{ 1e6, 1.5 }, PowerLaw{ 1e9, 2.0 },
    PowerLaw{ 500.0, 1.0 }, PowerLaw{ 5e3, 1.0 }, PowerLaw{ 1e12, 1.0 }));

// the largest force nowhere stiffer than K and nowhere above the law: min
// over s of F(s) + K (d - s)
TEST_P(AnyLaw, IsTheLargestForceThatADeviceMayRender)
{
  constexpr double kLimit = 1400.0;
  for (double depth = 0.1_mm; depth < 20.0_mm; depth += 0.7_mm)
  {
    double largest = kInf;
    for (double at = depth; at > 1e-12 * depth; at *= 0.999)
    {
      largest = std::min(largest, GetParam()(at).force + kLimit * (depth - at));
    }
    const Rendered felt = couple(GetParam(), depth, kLimit);
    largest = std::min(largest, kLimit * depth);
    EXPECT_NEAR(felt.force, largest, 1e-6 * largest) << depth;
    EXPECT_LE(felt.stiffness, kLimit);
  }
}

TEST_P(AnyLaw, ProxyLiesWhereTheLawGivesTheForceThatIsFelt)
{
  for (double depth = 0.1_mm; depth < 20.0_mm; depth += 0.7_mm)
  {
    const Rendered felt = couple(GetParam(), depth, 1400.0);
    EXPECT_LE(GetParam()(felt.proxyDepth).force, felt.force) << depth;
    EXPECT_GE(GetParam()(felt.proxyDepth + 1e-9 * depth).force, felt.force) << depth;
    EXPECT_LE(felt.proxyDepth, depth);
    EXPECT_NEAR(depthOf(GetParam(), felt.force, 1400.0, depth), depth, 1e-9 * depth);
  }
}

TEST(Coupling, SoftTissueIsFeltExactly)
{
  const PowerLaw liver{ 7.48e3, 1.5 }; // 50 kPa under a sphere of 10 mm: 1.1 kN/m at 10 mm
  const Rendered felt = couple(liver, 10.0_mm, 1400.0);
  EXPECT_EQ(felt.force, liver(10.0_mm).force);
  EXPECT_EQ(felt.proxyDepth, 10.0_mm);
  EXPECT_FALSE(felt.limited);
}

TEST(Coupling, RigidWallIsTheSpringAloneAndHoldsTheProxyOnItsSurface)
{
  const Rendered felt = couple(kRigid, 2.0_mm, 1400.0);
  EXPECT_NEAR(felt.force, 2.8, 1e-9);
  EXPECT_LT(felt.proxyDepth, 1e-12);
  EXPECT_TRUE(felt.limited);
}

TEST(Coupling, FollowsALawThatFallsBelowTheSpringAgain)
{
  const auto shelf = [](double depth) noexcept // stiff, then flat
  {
    return depth < 1.0_mm ? Response{ .force = 2e3 * std::max(0.0, depth), .stiffness = 2e3 }
                          : Response{ .force = 2.0 };
  };
  EXPECT_NEAR(couple(shelf, 1.0_mm, 1000.0).force, 1.0, 1e-9);
  EXPECT_EQ(couple(shelf, 5.0_mm, 1000.0).force, 2.0);
}

TEST(Coupling, GivesNoForceWithoutDepthOrLimitAndNoNaN)
{
  const PowerLaw law{ 7.48e3, 1.5 };
  for (const double bad : { 0.0, -1.0, kNaN })
  {
    EXPECT_EQ(couple(law, bad, 1400.0).force, 0.0);
    EXPECT_EQ(couple(law, 1.0_mm, bad).force, 0.0);
    EXPECT_EQ(depthOf(law, bad, 1400.0, 1.0_mm), 0.0);
  }
  EXPECT_EQ(couple(law, kInf, 1400.0).force, 0.0);
  EXPECT_EQ(couple(law, 1.0_mm, kInf).force, law(1.0_mm).force);
  const auto broken = [](double) noexcept { return Response{ .force = kNaN, .stiffness = kNaN }; };
  EXPECT_EQ(couple(broken, 1.0_mm, 1400.0).force, 0.0);
}

TEST(Coupling, AsksTheLawABoundedNumberOfTimes)
{
  int count = 0;
  const PowerLaw stiff{ 1e9, 2.0 };
  const auto counted = [&](double depth) noexcept
  {
    ++count;
    return stiff(depth);
  };
  (void)couple(counted, 10.0_mm, 1400.0);
  EXPECT_LE(count, 100);
}

// spectral radius of m x'' + b x' = u under u = -(K x + B dx/T) sampled, held, and d ticks late
double spectralRadius(double mass, const LoopDynamics& loop, double stiffness)
{
  const double period = loop.period;
  const double rate = loop.deviceDamping / mass;
  const double glide = -std::expm1(-rate * period) / rate;
  const int delay = static_cast<int>(std::lround(loop.delay / period));
  Eigen::MatrixXd step = Eigen::MatrixXd::Zero(3 + delay, 3 + delay); // x, v, older x
  Eigen::RowVectorXd push = Eigen::RowVectorXd::Zero(3 + delay);
  const auto column = [](int ticksAgo) { return ticksAgo == 0 ? 0 : 1 + ticksAgo; };
  push(column(delay)) -= stiffness + loop.virtualDamping / period;
  push(column(delay + 1)) += loop.virtualDamping / period;
  step(0, 0) = 1.0;
  step(0, 1) = glide;
  step(1, 1) = 1.0 - rate * glide;
  step.row(0) += (period - glide) / loop.deviceDamping * push;
  step.row(1) += glide / mass * push;
  for (int ticksAgo = 1; ticksAgo <= delay + 1; ++ticksAgo)
  {
    step(column(ticksAgo), column(ticksAgo - 1)) = 1.0;
  }
  return step.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(StableStiffness, LiesBetweenWhatDecaysAndWhatGrows)
{
  for (const double mass : { 0.05, 0.1, 0.3 })
  {
    for (const double damping : { 0.5, 1.0, 2.0 })
    {
      for (const double virtualDamping : { 0.0, 2.0 })
      {
        for (const int delay : { 0, 1, 2 })
        {
          const LoopDynamics loop{ damping, virtualDamping, 1.0_ms, delay * 1.0_ms };
          EXPECT_LT(spectralRadius(mass, loop, 0.8 * stableStiffness(loop)), 1.0);
          EXPECT_GT(spectralRadius(mass, loop, 1.3 * stableStiffness(loop)), 1.0);
        }
      }
    }
  }
}

} // namespace
} // namespace palp
