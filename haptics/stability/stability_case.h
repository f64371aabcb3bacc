#pragma once

#include "haptics/force/force_law.h"
#include "haptics/stability/arm_loop.h"
#include "haptics/stability/closed_loop.h"

#include <cstdint>
#include <optional>
#include <string>

namespace palp
{

/// One situation of the stability study.
struct StabilityCase
{
  std::string name;                 ///< what is varied, as in "period" or "swap"
  std::optional<Material> material; ///< none: a rigid wall
  Tip tip;
  LoopCase loop;                ///< without its chain; of an arm, only the period
  std::optional<ArmCase> arm{}; ///< instead: an arm, a bus and a hand in space
};

enum class StabilityOutcome
{
  Stable,   ///< and the law was felt as it is
  Limited,  ///< stable, because a stage of the chain acted
  Refused,  ///< pressed, but no force was given, or a fault of the chain ended it
  Unstable, ///< gave energy, did not come to rest, or went on in a limit cycle
};

/// What became of a case.
struct StabilityRow
{
  StabilityOutcome outcome = StabilityOutcome::Stable;
  std::string limitedBy;  ///< stages that acted, joined by +; "none"
  double peakForce = 0.0; ///< [N]
  double limitCycleSpeed =
    0.0;               ///< late speed with an encoder of kLimitCycleQuantum, or the arm's [m/s]
  double energy = 0.0; ///< least of port energy + integral of b v^2, exact encoder [J]
};

/// What counts as unstable.
/// @source  energy and envelope: the rest of a held press; limit cycle: the
///          smallest that fingers notice
struct StabilityLimits
{
  static constexpr double kEnergy = -1e-6;            ///< [J]
  static constexpr double kEnvelope = 0.1;            ///< late by early speed [-]
  static constexpr double kLimitCycleSpeed = 0.025;   ///< [m/s]
  static constexpr double kLimitCycleQuantum = 48e-6; ///< [m], that of a Novint Falcon
  static constexpr double kAtRest = 1e-4;             ///< speed below which nothing grows [m/s]
};

/// Names of the stages of the chain that raised a flag, joined by +; "none".
[[nodiscard]] std::string stagesIn(std::uint32_t flags);

} // namespace palp
