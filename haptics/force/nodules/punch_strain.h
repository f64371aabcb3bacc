#pragma once

#include "haptics/force/nodules/strain.h"

namespace palp
{

/// Strain in a half-space under a rigid frictionless flat punch, over its depth and its radius, so
/// that a radius of nearly 0 leaves that of a point load.
///
/// @param radius        a of the punch [m], more than 0
/// @param r             from its axis [m], 0 or more
/// @param z             below the surface [m], more than 0
/// @param poissonRatio  nu, 0 to 0.5
/// @return              strain / (depth a) [1/m^2]
/// @source              Sneddon 1965, by the potential Im log(h + z + i a), h^2 = r^2 + (z + i a)^2
[[nodiscard]] Strain punchStrain(double radius, double r, double z, double poissonRatio) noexcept;

} // namespace palp
