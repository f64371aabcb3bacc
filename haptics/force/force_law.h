#pragma once

#include "haptics/force/half_space.h"
#include "haptics/material.h"

#include <limits>

namespace palp
{

/// What the law may know of the place that is pressed. Everything but the depth has a
/// neutral default, under which the body is a half-space pressed straight.
struct Indentation
{
  double depth = 0.0;                                         ///< delta [m]
  double tilt = 0.0;                                          ///< tool axis to inward normal [rad]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body under the tool [m]
  double surfaceCurvature = 0.0;                              ///< mean, 1/R0 [1/m], convex positive
};

/// What the tissue answers.
struct Response
{
  double force = 0.0;         ///< F [N] along the outward normal, 0 or more
  double contactRadius = 0.0; ///< r [m], at most the base radius
  double stiffness = 0.0;     ///< dF/ddepth [N/m]
};

/// Which law answers.
enum class LawMode
{
  Paper, ///< Eqs. (2)-(5) for sphere and cone, exact for other tips; nothing else
  Exact, ///< the exact linear half-space for every tip; nothing else
};

struct LawSettings
{
  LawMode mode = LawMode::Paper;
};

/// Reaction of soft tissue to a rigid tip: Eq. (1), F = Phi(tip, depth, E, nu).
///
/// Built while setting up; asked inside the servo loop.
class ForceLaw
{
public:
  /// @throws Error  BadValue: see checkedTip and makeMaterial
  ForceLaw(const Tip& tip, const Material& material, LawSettings settings = {});

  /// @param local  where and how deep; depth of 0 or less, or not finite, is no contact
  /// @source       Eqs. (2)-(5)
  /// @realtime     pure; no allocation, no lock, no exception
  [[nodiscard]] Response operator()(const Indentation& local) const noexcept;

  [[nodiscard]] const Tip& tip() const noexcept
  {
    return tip_;
  }
  [[nodiscard]] const Material& material() const noexcept
  {
    return material_;
  }
  [[nodiscard]] const LawSettings& settings() const noexcept
  {
    return settings_;
  }

private:
  Tip tip_;
  Material material_;
  LawSettings settings_;
  HalfSpace halfSpace_;
};

} // namespace palp
