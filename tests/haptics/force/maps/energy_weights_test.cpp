#include "haptics/force/maps/energy_weights.h"

#include "haptics/units.h"
#include "tests/haptics/force/nodules/nodule_cases.h"
#include "tests/haptics/force/reference_table.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>

namespace palp
{
namespace
{

using namespace units::literals;
using Place = Eigen::Vector3d;

// E over that of the press, as the head of data/reference/maps_axisym.csv has it
double referenceRatio(char map, const Place& at)
{
  const double z = units::toMillimeters(at.z());
  const double r = units::toMillimeters(at.head<2>().norm());
  switch (map)
  {
    case 'A':
      return z > 10.0 ? 3.0 : 1.0;
    case 'B':
      return z < 2.0 ? 3.0 : 1.0;
    case 'C':
      return 1.0 + z / 20.0;
    default:
      return r < 6.0 ? 2.0 : 1.0;
  }
}

HomogeneousPress pressBy(double radius)
{
  return test::NoduleCase{
    .tip = SphereTip{ radius }, .poisson = 0.45, .thickness = 40.0_mm, .deepest = 8.0_mm
  }
    .press();
}

// of a quantity at the knots, at a depth
double atDepth(const HomogeneousPress& press, std::span<const double> values, double depth)
{
  return CubicSpline(press.axis(), values)(std::sqrt(depth)).value;
}

TEST(EnergyWeights, SumToOneByVirtualWork)
{
  for (const double thickness : { 30.0_mm, 40.0_mm, std::numeric_limits<double>::infinity() })
  {
    const HomogeneousPress press =
      test::NoduleCase{
        .tip = SphereTip{ 10.0_mm }, .poisson = 0.45, .thickness = thickness, .deepest = 8.0_mm
      }
        .press();
    const EnergyWeights weights(press);
    // as deep as was asked for
    const auto inUse = static_cast<std::size_t>(0.9 * HomogeneousPress::kIntervals) + 1;
    const std::span<const double> sums = weights.sums().first(inUse);
    // of a half-space a part stays beyond the farthest place
    const double least = std::isfinite(thickness) ? 0.99 : 0.95;
    EXPECT_GT(std::ranges::min(sums), least) << thickness;
    EXPECT_LT(std::ranges::max(sums), 1.01) << thickness;
  }
}

TEST(EnergyWeights, FollowFiniteElementsOverMapsOfStiffness)
{
  const std::map<double, HomogeneousPress> presses{ { 10.0_mm, pressBy(10.0_mm) },
    { 6.0_mm, pressBy(6.0_mm) } };
  std::size_t rows = 0;
  double worst = 0.0;
  double worstMean = 0.0;
  for (const auto& [radius, press] : presses)
  {
    const EnergyWeights weights(press);
    for (const test::ReferenceRow& row : test::referenceTable("maps_axisym"))
    {
      if (row.number("R_m") != radius)
      {
        continue;
      }
      const char map = row.text("map").front();
      const EnergyWeights::Means means =
        weights.means([&](const Place& at) { return referenceRatio(map, at); });
      const double log = atDepth(press, means.logs, row.number("d_m"));
      const double force = row.number("F_hom_N") * std::exp(log);
      worst = std::max(worst, std::abs(force / row.number("F_N") - 1.0));
      const double oracle =
        0.65 * std::log(row.number("m_geo")) + 0.35 * std::log(row.number("m_har"));
      worstMean = std::max(worstMean, std::abs(std::expm1(log - oracle)));
      ++rows;
    }
  }
  EXPECT_EQ(rows, 40U);
  EXPECT_LT(worst, 0.05) << "of finite elements";
  EXPECT_LT(worstMean, 0.01) << "of the oracle's means";
  RecordProperty("worst_of_elements", std::to_string(worst));
  RecordProperty("worst_of_oracle", std::to_string(worstMean));
}

TEST(EnergyWeights, AnEvenStiffnessIsFeltAsItIs)
{
  const EnergyWeights::Means means =
    EnergyWeights(pressBy(10.0_mm)).means([](const Place&) { return 0.3; });
  for (std::size_t k = 0; k < means.logs.size(); ++k)
  {
    EXPECT_NEAR(means.logs[k], std::log(0.3), 1e-12);
    EXPECT_NEAR(means.spreads[k], 0.0, 1e-12);
  }
  EXPECT_NEAR(means.known, 1.0, 1e-12);
}

// also of very soft and very stiff tissue at any depth: never beyond either of the two
TEST(EnergyWeights, AMeanLiesBetweenWhatIsThere)
{
  const EnergyWeights weights(pressBy(10.0_mm));
  for (const double ratio : { 1e-6, 1e-3, 0.1, 10.0, 1e3, 1e6 })
  {
    for (double border = 0.5_mm; border < 80.0_mm; border *= 1.3)
    {
      const EnergyWeights::Means means =
        weights.means([&](const Eigen::Vector3d& at) { return at.z() > border ? ratio : 1.0; });
      for (std::size_t k = 0; k < means.logs.size(); ++k)
      {
        EXPECT_GE(means.logs[k], std::min(0.0, std::log(ratio)) - 1e-12) << ratio << ' ' << border;
        EXPECT_LE(means.logs[k], std::max(0.0, std::log(ratio)) + 1e-12) << ratio << ' ' << border;
        EXPECT_GE(means.spreads[k], -1e-12) << ratio << ' ' << border;
      }
    }
  }
}

TEST(EnergyWeights, WhatIsNotKnownDoesNotCount)
{
  const EnergyWeights weights(pressBy(10.0_mm));
  const auto half = [](const Place& at)
  { return at.x() > 0.0 ? 2.0 : std::numeric_limits<double>::quiet_NaN(); };
  const EnergyWeights::Means means = weights.means(half);
  EXPECT_NEAR(means.logs.back(), std::log(2.0), 1e-12);
  EXPECT_NEAR(means.known, 0.5, 0.2);
  EXPECT_EQ(
    weights.means([](const Place&) { return std::numeric_limits<double>::quiet_NaN(); }).known,
    0.0);
}

} // namespace
} // namespace palp
