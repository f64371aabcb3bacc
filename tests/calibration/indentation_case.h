#pragma once

#include "calibration/study/study.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace palp::fem
{

using namespace units::literals;

inline std::vector<double> depthRange(double first, double last, double step)
{
  std::vector<double> depths;
  for (double d = first; d < last + 0.5 * step; d += step)
  {
    depths.push_back(d);
  }
  return depths;
}

/// The paper's calibration: R = 10 mm, block 100 x 100 x 50 mm, 50 kPa, 0.33.
inline Case paperCase(StrainEnergy energy = StrainEnergy::NeoHookean)
{
  return { .name = "paper",
    .tip = SphereTip{ 10.0_mm },
    .energy = energy,
    .depths = depthRange(1.0_mm, 10.0_mm, 1.0_mm),
    .elementSize = 1.0_mm };
}

inline Tip cappedCone()
{
  return BluntConeTip{ .halfAngle = 45.0_deg, .tipRadius = 0.3_mm, .baseRadius = 10.0_mm };
}

/// Hertz's force on a half-space under a paraboloid [N].
inline double hertzForce(const Case& study, double radius, double depth)
{
  return 4.0 / 3.0 * study.material.contactModulus() * std::sqrt(radius) * std::pow(depth, 1.5);
}

/// Force on a linear layer under a paraboloid over Hertz's, to the third order of chi.
/// @param chi  contact radius over thickness, of the half-space [-]
/// @param m0   and m2: integrals of the layer, by Poisson's ratio and base [-]
inline double layerFactor(double chi, double m0, double m2)
{
  constexpr double pi = std::numbers::pi;
  return 1.0 + 2.0 / pi * m0 * chi + 14.0 / (3.0 * pi * pi) * m0 * m0 * chi * chi +
    (5.0 * std::pow(4.0 / (3.0 * pi), 3) * std::pow(m0, 3) - 8.0 / (15.0 * pi) * m2) *
    std::pow(chi, 3);
}

inline Outcome completed(const Case& study)
{
  Outcome outcome = calibrate(study);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.steps.size(), study.depths.size());
  return outcome;
}

} // namespace palp::fem
