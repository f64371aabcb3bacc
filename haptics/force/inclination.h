#pragma once

#include "haptics/tip/tip.h"

namespace palp
{

/// Force on a frictionless tip, which acts along the surface's normal, as an inclined tool feels
/// it.
struct InclinedForce
{
  double axial;   ///< along the tool [N]
  double lateral; ///< across the tool [N]
};

/// @param force  along the normal [N]
/// @param tilt   tool axis to inward normal [rad]
/// @source       Eq. (7)
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] InclinedForce inclinedForce(double force, double tilt) noexcept;

/// Tilt at which the axial force falls short of the normal one by a fraction.
/// @source Eq. (7): arccos(1 - 0.07) = 21.6 degrees
[[nodiscard]] double tiltOfShare(double fraction) noexcept;

/// Factor on the normal force of a tilted sharp cone over the upright one, at the same depth of
/// its apex; 1 for any other tip, and exactly so for a sphere.
///
/// Computed at a half angle of 45 degrees up to a tilt of 30 degrees; other cones take the
/// same curve over a tilt that is scaled to reach 7 % where theirs do.
///
/// @param tilt  [rad], either sign
/// @source      boundary elements on the linear half-space, data/reference
/// @realtime    pure; no allocation, no lock, no exception
[[nodiscard]] double tiltFactor(const Tip& tip, double tilt) noexcept;

/// Largest tilt at which tiltFactor was compared, 0 for any tip but a sharp cone: 25, 30 and 15
/// degrees at half angles of 30, 45 and 60; in proportion between, and down to 0 at 90.
/// @return [rad]
[[nodiscard]] double tiltReach(const Tip& tip) noexcept;

} // namespace palp
