#pragma once

#include "haptics/force/force_law.h"
#include "haptics/servo/safety.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace palp
{

/// A device held by a hand, seen along one line.
struct Plant
{
  double mass = 0.1;                   ///< [kg]
  double damping = 1.0;                ///< b [N s/m], above 0
  std::optional<double> statedDamping; ///< what the chain believes b to be [N s/m]; none: b
  double quantum = 0.0;                ///< of its encoder [m]
  int delay = 0;                       ///< ticks from a force computed to the force that acts
  double maxForce = 7.9;               ///< of its motors [N]
  double handForce = 1.0;              ///< constant push toward the tissue [N]
  double startDepth = -0.005;          ///< [m]
  double startSpeed = 0.2;             ///< toward the tissue [m/s]
};

/// A loop of plant and law in virtual time.
struct LoopCase
{
  Plant plant;
  std::function<Response(double depth)> law;     ///< force 0 at depth 0; infinite for a rigid wall
  std::function<Response(double depth)> swapped; ///< takes its place in contact; empty: never
  double swapAt = 1.0;                           ///< [s]
  double swapRise = 0.0;                         ///< of the surface at the swap [m]
  double damping = 0.0;                          ///< B of the law [N s/m]
  double forceLimit = 4.0;                       ///< [N], chain only
  double period = 0.001;                         ///< T [s]
  double jitter = 0.0;                           ///< of the period, both ways, as a fraction of it
  int dropped = 0;                               ///< ticks lost in a row
  double dropEvery = 0.25;                       ///< [s]
  double duration = 20.0;                        ///< [s]
  std::optional<SafetySettings> chain;           ///< none: the law goes to the motors as it is
};

/// What the plant saw, which no controller can talk better.
struct LoopResult
{
  double energy = 0.0;     ///< least of port energy + integral of b v^2 [J]; passive: 0 or more
  double portEnergy = 0.0; ///< least energy taken from the hand by the force [J]
  double portEnd = 0.0;    ///< the same at the end [J]
  double observedEnergyEnd = 0.0; ///< what the chain believes it is [J]
  double peakForce = 0.0;         ///< [N]
  double peakStep = 0.0;          ///< largest change of force between two ticks [N]
  double earlySpeed = 0.0;        ///< largest between 1/8 and 1/4 of the duration [m/s]
  double limitCycleSpeed = 0.0;   ///< largest under a force in the last eighth [m/s]
  double tailSpeed = 0.0;         ///< root mean square in the last quarter [m/s]
  double endDepth = 0.0;          ///< [m]
  double endForce = 0.0;          ///< [N]
  bool ended = false;             ///< a fault of the chain ended the force for good
  std::uint32_t flags = 0;        ///< of Flag, raised at least once
};

/// Plays a case. The plant moves exactly under a force that is held over each tick; its energy is
/// that of the force which acted, not of the one which was asked for.
[[nodiscard]] LoopResult simulate(const LoopCase& loop);

} // namespace palp
