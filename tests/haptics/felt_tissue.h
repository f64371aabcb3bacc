#pragma once

#include "haptics/servo/safety.h"
#include "haptics/units.h"

#include <gtest/gtest.h>

namespace palp
{

/// Pressed 5 mm deep by a ball of 10 mm, tissues differ on an arm in a hand by the 22 % that hands
/// tell apart of compliance (Tan 1995).
inline void expectTissuesToBeToldApart(const DeviceLimits& limits)
{
  using namespace units::literals;
  const double stiffest = SafetyChain(limits).stiffnessLimit(0.0);
  double softer = 0.0;
  for (const double modulus : { 5.0_kPa, 10.0_kPa, 50.0_kPa })
  {
    const ForceLaw law(SphereTip{ .radius = 10.0_mm }, makeMaterial(modulus, 0.33));
    const auto ask = [&](double depth) noexcept { return law({ .depth = depth }); };
    const double felt = couple(ask, 5.0_mm, stiffest).force;
    EXPECT_GE(felt, 1.22 * softer) << limits.model << " " << modulus;
    softer = felt;
  }
}

} // namespace palp
