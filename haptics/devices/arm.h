#pragma once

#include <array>

namespace palp
{

/// What was measured of an arm along one axis of its own frame, in the newtons that it is told.
struct ArmAxis
{
  double mass = 0.0;      ///< of what moves with the handle [kg]
  double damping = 0.0;   ///< viscous [N s/m]
  double friction = 0.0;  ///< Coulomb [N]
  double agreement = 0.0; ///< cosine between a push and the motion that follows, -1 to 1
};

/// An arm as identifyArm finds it; the stiffness that it can render follows from these.
struct IdentifiedArm
{
  std::array<ArmAxis, 3> axes{};
  double delay = 0.0;       ///< from a command to the position that shows it [s]
  double encoderStep = 0.0; ///< smallest step of the positions [m]
  double scale = 1.0;       ///< newtons that a hand feels for one that is told; 1: not measured
  double late = 0.0;        ///< part of the exchanges that the computer was late in; not kept

  /// Below it a motion does not follow its push: the sign or the place of a motor is wrong.
  static constexpr double kAgrees = 0.7;
  /// Of any arm [kg]: less was not measured.
  static constexpr double kLeastMass = 1e-3;

  [[nodiscard]] bool agrees() const noexcept
  {
    return axes[0].agreement >= kAgrees && axes[1].agreement >= kAgrees &&
      axes[2].agreement >= kAgrees;
  }
};

} // namespace palp
