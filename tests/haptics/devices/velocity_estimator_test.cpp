#include "haptics/devices/velocity_estimator.h"

#include "haptics/units.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

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

// by its definition, in whole quanta and periods, where nothing is rounded
long long slopeWindow(const std::vector<long long>& newestFirst, std::size_t longest)
{
  std::size_t window = 1;
  for (std::size_t next = 2; next <= longest && next < newestFirst.size(); ++next)
  {
    const auto periods = static_cast<long long>(next);
    const long long rise = newestFirst[0] - newestFirst[next];
    for (std::size_t i = 1; i < next; ++i)
    {
      const long long off =
        (newestFirst[i] - newestFirst[0]) * periods + rise * static_cast<long long>(i);
      if (std::abs(off) > periods)
      {
        return static_cast<long long>(window);
      }
    }
    window = next;
  }
  return static_cast<long long>(window);
}

TEST(VelocityEstimator, TakesTheLongestWindowWhoseLineIsWithinAQuantumOfAll)
{
  std::mt19937 random(5);
  for (const double period : { 0.25_ms, 0.7_ms, 1.0_ms, 3.0_ms })
  {
    const auto longest = static_cast<std::size_t>(9.0_ms / period + 1e-6);
    for (const double drift : { 0.0, 0.3, 1.0, 4.5 })
    {
      VelocityEstimator estimate(kQuantum);
      std::normal_distribution<double> step(drift, 0.6);
      std::vector<long long> newestFirst{};
      double place = 1000.0;
      std::size_t adapted = 0;
      for (int tick = 0; tick < 4000; ++tick)
      {
        place += step(random) * (tick % 400 < 200 ? 1.0 : -0.1);
        newestFirst.insert(newestFirst.begin(), std::llround(place));
        newestFirst.resize(std::min<std::size_t>(newestFirst.size(), 41));
        const double found =
          estimate(Vector3d(0, 0, static_cast<double>(newestFirst[0]) * kQuantum), period).z();
        if (tick > 0)
        {
          const long long window = slopeWindow(newestFirst, longest);
          const long long rise = newestFirst[0] - newestFirst[static_cast<std::size_t>(window)];
          const double expected =
            static_cast<double>(rise) * kQuantum / (static_cast<double>(window) * period);
          ASSERT_NEAR(found, expected, 1e-9 + 1e-9 * std::abs(expected)) << period << " " << tick;
          adapted += window > 1 ? 1 : 0;
        }
      }
      EXPECT_GT(adapted, 400U) << "windows adapt";
    }
  }
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
