#pragma once

#include "calibration/study/study.h"
#include "haptics/units.h"
#include "tests/haptics/force/reference_table.h"

#include <cmath>
#include <gtest/gtest.h>

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
inline Case paperCase(Energy energy = Energy::NeoHookean)
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

inline Outcome completed(const Case& study)
{
  Outcome outcome = calibrate(study);
  EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(outcome.steps.size(), study.depths.size());
  return outcome;
}

} // namespace palp::fem
