#pragma once

#include "haptics/stability/stability_case.h"

#include <vector>

namespace palp
{

/// What counts as unstable of an arm.
///
/// A heavy arm that nothing brakes comes to rest late in any world, so its speed is held against
/// what its own damping and its hand's would leave of it.
struct ArmStabilityLimits
{
  static constexpr double kDecay = 0.2; ///< of the decay by device and hand alone
  /// That the loop may give before it is found to swing: of an arm whose delay is told as it is,
  /// and of any other [J].
  static constexpr double kEnergy = -5e-3;
  static constexpr double kBlindEnergy = -50e-3;
};

/// Arms, buses and hands over the whole range of those that exist, at tissue, at a curved surface
/// and at the end of their reach: a Latin hypercube of levels, always the same.
///
/// @param count  how many
[[nodiscard]] std::vector<StabilityCase> armCases(int count);

/// Plays a case once, through the chain or without.
[[nodiscard]] StabilityRow judgeArm(const ArmCase& arm, bool chain);

} // namespace palp
