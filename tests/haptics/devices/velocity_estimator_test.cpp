#include "haptics/devices/velocity_estimator.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace palp
{
namespace
{

using namespace units::literals;
using Eigen::Vector3d;

constexpr double kQuantum = 48.0_um;

double seen(double x)
{
  return std::floor(x / kQuantum) * kQuantum;
}

TEST(VelocityEstimator, NoiseOfACoarseEncoderStaysBelowFiveMillimetersPerSecond)
{
  for (double speed = 1.0_mm; speed < 0.5; speed *= 1.37)
  {
    VelocityEstimator estimate(kQuantum);
    double sum = 0.0;
    for (int tick = 0; tick < 3000; ++tick)
    {
      const double x = seen(speed * tick * 1.0_ms);
      const double error = estimate(Vector3d(0, x, 0), 1.0_ms).y() - speed;
      sum += tick >= 100 ? error * error / 2900.0 : 0.0;
    }
    EXPECT_LE(std::sqrt(sum), 5.0_mm) << speed;
  }
}

// a delay of tau turns the phase of a slow oscillation by omega tau
TEST(VelocityEstimator, DelayIsAtMostFiveMilliseconds)
{
  for (const double frequency : { 0.5, 1.0, 2.0, 5.0 })
  {
    VelocityEstimator estimate(kQuantum);
    const double omega = 2.0 * std::numbers::pi * frequency;
    double sine = 0.0;
    double cosine = 0.0;
    for (int tick = 0; tick < 10000; ++tick)
    {
      const double phase = omega * tick * 1.0_ms;
      const double v = estimate(Vector3d(seen(20.0_mm * std::sin(phase)), 0, 0), 1.0_ms).x();
      sine += v * std::sin(phase);
      cosine += v * std::cos(phase);
    }
    EXPECT_LE(std::atan2(sine, cosine) / omega, 5.0_ms) << frequency;
  }
}

TEST(VelocityEstimator, IsExactlyZeroAtRest)
{
  VelocityEstimator estimate(kQuantum);
  for (int tick = 0; tick < 100; ++tick)
  {
    (void)estimate(Vector3d::Constant(seen(0.1 * tick * 1.0_ms)), 1.0_ms);
  }
  Vector3d velocity;
  for (int tick = 0; tick < 50; ++tick)
  {
    velocity = estimate(Vector3d::Constant(seen(9.9_mm)), 1.0_ms);
  }
  EXPECT_EQ(velocity, Vector3d::Zero());
}

TEST(VelocityEstimator, WithoutQuantumIsTheBackwardDifference)
{
  VelocityEstimator estimate(0.0);
  EXPECT_EQ(estimate(Vector3d(1.0, 0, 0), 0.5), Vector3d::Zero());
  EXPECT_EQ(estimate(Vector3d(2.0, 0, 0), 0.5), Vector3d(2.0, 0, 0));
  EXPECT_EQ(estimate(Vector3d(2.5, 0, 0), 0.25), Vector3d(2.0, 0, 0));
}

TEST(VelocityEstimator, GivesNoNaN)
{
  VelocityEstimator estimate(kQuantum);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  (void)estimate(Vector3d::Zero(), 1.0_ms);
  EXPECT_TRUE(estimate(Vector3d(nan, 0, 0), 1.0_ms).allFinite());
  EXPECT_TRUE(estimate(Vector3d::Zero(), nan).allFinite());
  EXPECT_TRUE(estimate(Vector3d::Zero(), 0.0).allFinite());
  EXPECT_TRUE(estimate(Vector3d::Zero(), 1.0_ms).allFinite());
}

} // namespace
} // namespace palp
