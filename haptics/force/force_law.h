#pragma once

#include "haptics/force/tip.h"
#include "haptics/material.h"

#include <limits>

namespace palp
{

/// What the law may know of the place that is pressed. Everything but the depth has a
/// neutral default, under which the body is a half-space pressed straight.
struct Indentation
{
  double depth = 0.0;                                       ///< delta [m]
  double tilt = 0.0;                                        ///< tool axis to inward normal [rad]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body under the tool [m]
  double surfaceCurvature = 0.0;                            ///< mean, 1/R0 [1/m], convex positive
};

/// What the tissue answers.
struct Response
{
  double force = 0.0;         ///< F [N] along the outward normal, 0 or more
  double contactRadius = 0.0; ///< r [m], at most the base radius
  double stiffness = 0.0;     ///< dF/ddepth [N/m]
};

/// Reaction of soft tissue to a rigid tip: Eq. (1), F = Phi(tip, depth, E, nu).
///
/// Built while setting up; asked inside the servo loop.
class ForceLaw
{
public:
  /// The paper's laws: Eqs. (2)-(5) for sphere and cone, the exact half-space law for other tips.
  /// @throws Error  BadValue: see checkedTip and makeMaterial
  ForceLaw(const Tip& tip, const Material& material);

  /// @param local  where and how deep; depth of 0 or less, or NaN, is no contact
  /// @source       Eqs. (2)-(5)
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Response operator()(const Indentation& local) const noexcept;

  [[nodiscard]] const Tip& tip() const noexcept { return tip_; }
  [[nodiscard]] const Material& material() const noexcept { return material_; }

private:
  Tip tip_;
  Material material_;
};

} // namespace palp
