#pragma once

#include <algorithm>
#include <cmath>

namespace palp
{

/// A curvature that levels off, so that a body stays larger than what touches it.
struct Leveled
{
  double value;  ///< [1/m]
  double slope;  ///< over the curvature [-]
  double bySize; ///< over that size [1/m^2]
};

/// @param curvature  [1/m], either sign; as it is up to half of 1 / size, and below 0.9 beyond
/// @param size       of what touches the body [m], above 0
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] inline Leveled leveled(double curvature, double size) noexcept
{
  constexpr double kRound = 0.5;    // [-] 1 / size
  constexpr double kRoundest = 0.4; // [-] by how much it levels off beyond
  const double steep = std::abs(curvature);
  const double beyond = std::max(0.0, steep * size - kRound) / kRoundest;
  const double within = std::min(steep, kRound / size) + kRoundest / size * beyond / (1.0 + beyond);
  const double slope = 1.0 / ((1.0 + beyond) * (1.0 + beyond));
  const double bySize = beyond > 0.0 ? (slope * steep - within) / size : 0.0;
  return { std::copysign(within, curvature), slope, curvature < 0.0 ? -bySize : bySize };
}

} // namespace palp
