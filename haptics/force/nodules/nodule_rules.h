#pragma once

#include "haptics/force/nodules/nodule.h"
#include "haptics/force/validity.h"

#include <array>
#include <limits>
#include <span>

namespace palp
{

/// Radius over depth of the center up to which nodules were compared with finite elements. To there
/// a larger one below the same cover adds more, or takes more.
inline constexpr double kClosestNodule = 0.8;

/// A press over nodules, as far as their validity depends on it.
struct NodulePress
{
  double depth = 0.0;                                         ///< [m]
  double contactRadius = 0.0;                                 ///< a [m]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body [m]
  double added = 0.0; ///< by the nodules, of the force with them [-]
  double bend = 0.0;  ///< how much deeper or less deep one lies than its force takes it [-]
};

using NoduleRules = std::array<Rule, 3>;

/// How far a force over nodules may be believed: where they lie, below a surface that bends, and
/// how much large strain may add.
///
/// @param nodules       that matter, none to many
/// @param constitution  of the law
/// @source              linear and neo-Hookean finite elements, 1872 and 26 cases
/// @realtime            pure; no allocation, no lock, no exception
[[nodiscard]] NoduleRules noduleRules(std::span<const Nodule> nodules, const NodulePress& press,
  ConstitutiveModel constitution) noexcept;

} // namespace palp
