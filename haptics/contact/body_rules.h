#pragma once

#include "haptics/contact/contact.h"
#include "haptics/force/validity.h"
#include "haptics/surface/surface.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// Where nobody says what a body rests on, and the law takes it as held flat below the tool:
/// whether it is so thin there that this matters.
///
/// Half of the body, as a lobe of a thicker one; or 0.4 of its extent: held at one end it gives
/// way by bending and shear as much as a contact of a fifth of its thickness does, or more.
/// Or a wedge of less than 80 degrees near its edge, by 7 % of the force or more, or an upright one
/// whatever is said, also where it is rounded. Doubtful everywhere else, as it depends on what
/// nobody says. And whatever is below, whether the body is compressed along the press, as a rod of
/// the section of its box, by 7 % of what the contact yields more than the law knows of.
///
/// @param contactRadius  [m]
///
/// @source    Timoshenko, Strength of Materials I, 1955, Sec. 39 (cantilever, with shear)
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule lobeRule(
  const Surface& surface, const Contact& contact, double contactRadius, Base base) noexcept;

/// Whether nothing is known of what lies behind the surface, which is open: the law then takes the
/// body as without end. A bonded base 2, 6 and 10 contact radii below makes it 1.8, 1.2 and 1.1
/// times as stiff (flat punch, nu 0.45).
///
/// @source    haptics/force/linear/layer_contact.h
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule openRule(const Surface& surface, const Contact& contact) noexcept;

/// Whether the surface below a tool is not the even one that it is taken as.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule unevenRule(const Tip& tip, const Contact& contact) noexcept;

/// Whether triangles that stand for what is round are so large that they are smoothed over a sharp
/// edge beside the contact.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Rule facetRule(
  const Surface& surface, const Tip& tip, const Contact& contact) noexcept;

} // namespace palp
