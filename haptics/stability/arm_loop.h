#pragma once

#include "haptics/servo/scene.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace palp
{

/// What a simulated tool runs into.
enum class ArmWorld
{
  Plane,     ///< the tissue z < 0, pressed straight down
  Sphere,    ///< tissue of 50 mm radius, pressed aslant, so that the tool slides off
  Workspace, ///< the end of the device's reach
  Scene,     ///< a scene whose surface lies at z = 0, pressed and then drawn along
};

/// A haptic arm, its bus, and the hand on it.
struct ArmCase
{
  double mass = 0.1;          ///< [kg]
  double damping = 0.2;       ///< b [N s/m]
  double friction = 0.0;      ///< Coulomb's [N]
  double quantum = 0.0;       ///< of the encoders, per axis [m]
  double delay = 0.0;         ///< from a pose sampled to its force acting [s]
  double statedDelay = 0.0;   ///< what the chain is told of it [s]
  double statedHand = 0.0;    ///< damping of a hand that the chain counts on [N s/m]
  double handStiffness = 0.0; ///< [N/m]; 0: the hand pushes with a constant force
  double handDamping = 0.0;   ///< [N s/m]
  double handForce = 1.0;     ///< [N]
  double handDepth = 0.005;   ///< of what the spring of a hand pulls to [m]
  double scale = 1.0;         ///< motion of the tool by that of the hand, which all else is of
  double period = 0.001;      ///< of the bus [s]
  double startSpeed = 0.2;    ///< [m/s]
  double duration = 8.0;      ///< [s]
  ArmWorld world = ArmWorld::Plane;
  std::function<Response(double depth)> law{}; ///< of the tissue, but of a scene
  std::shared_ptr<const Scene> scene{};        ///< of ArmWorld::Scene
  double drawnSpeed = 0.0; ///< of the hand along that, over 30 mm from 1 s on [m/s]
};

/// What the arm did; lengths and speeds are of the tool.
struct ArmResult
{
  double energy = 0.0;        ///< least of port energy + what the mechanism dissipated [J]
  double portEnd = 0.0;       ///< energy taken from the hand by the force, at the end [J]
  double observedEnd = 0.0;   ///< the same as the chain observed it [J]
  double worstObserved = 0.0; ///< largest difference of both, at any tick [J]
  double peakForce = 0.0;     ///< [N]
  double earlySpeed = 0.0;    ///< largest between 1/8 and 1/4 of the duration [m/s]
  double lateSpeed = 0.0;     ///< largest in the last eighth [m/s]
  double middleSpeed = 0.0;   ///< largest between 5/8 and 3/4 [m/s]
  double endDepth = 0.0;      ///< in the tissue, or beyond the workspace [m]
  std::uint32_t flags = 0;    ///< of Flag, raised at least once
  bool ended = false;         ///< a fault of the chain ended the force for good
};

/// Plays a case through the safety chain, or, for comparison, with the law on the motors as it is.
/// The arm is integrated many times finer than the bus looks.
[[nodiscard]] ArmResult simulateArm(const ArmCase& arm, bool chain = true);

} // namespace palp
