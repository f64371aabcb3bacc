#pragma once

#include "haptics/tip/tip.h"

#include <algorithm>
#include <cmath>

namespace palp
{

/// Depth at which the circle of contact with a half-space reaches a radius: g(a) of the method
/// of dimensionality reduction.
///
/// @param radius  a [m], 0 to the base radius
/// @return        [m]; infinite at the equator of a sphere
/// @source        Sneddon 1965; blunt cone: Ciavarella 1999
[[nodiscard]] double contactDepth(const Tip& tip, double radius) noexcept;

/// The same of a sphere, which is the cap of a blunt cone, too.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline double contactDepth(const SphereTip& tip, double a) noexcept
{
  return a * std::atanh(a / tip.radius);
}

/// A cone whose tip is a cap: the lengths that its formulas share.
struct CappedCone
{
  explicit CappedCone(const BluntConeTip& tip) noexcept
    : rho(tip.tipRadius)
    , b(rho * std::cos(tip.halfAngle))
    , n(rho * std::sin(tip.halfAngle))
  {
  }

  /// sqrt(a^2 - b^2) [m]
  [[nodiscard]] double m(double a) const noexcept
  {
    return std::sqrt(std::max(0.0, (a - b) * (a + b)));
  }

  /// depth / a beyond the cap [-]
  [[nodiscard]] double steepness(double a) const noexcept
  {
    return std::log((a + rho) / (m(a) + n)) + b / n * std::acos(std::min(1.0, b / a));
  }

  double rho; ///< of the cap [m]
  double b;   ///< radius where cap and flank meet [m]
  double n;   ///< height of the cap's center over that circle [m]; b / n = cot(alpha)
};

} // namespace palp
