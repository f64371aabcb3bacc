#pragma once

#include "haptics/force/force_law.h"
#include "haptics/stability/closed_loop.h"

#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// One situation of the stability study.
struct StabilityCase
{
  std::string name;                 ///< what is varied, as in "period" or "swap"
  std::optional<Material> material; ///< none: a rigid wall
  Tip tip;
  LoopCase loop; ///< without its chain
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
  std::string limitedBy;        ///< stages that acted, joined by +; "none"
  double peakForce = 0.0;       ///< [N]
  double limitCycleSpeed = 0.0; ///< late speed with an encoder of kLimitCycleQuantum [m/s]
  double energy = 0.0;          ///< least of port energy + integral of b v^2, exact encoder [J]
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

/// The cases: soft to rigid, compressible to nearly not, first touch to deeper than the tool,
/// sharp cone and flat punch, fast and slow loops, jitter and lost ticks, another tissue or surface
/// in contact, other devices, delays, hands that tap and hands that lean.
///
/// @param quick  a tenth of them
[[nodiscard]] std::vector<StabilityCase> stabilityCases(bool quick);

/// Plays a case twice, with an exact and with a coarse encoder, through the chain or without.
[[nodiscard]] StabilityRow judge(const StabilityCase& which, bool chain);

} // namespace palp
