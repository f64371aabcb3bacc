#pragma once

#include "haptics/numerics/smooth_step.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// How large a ball about a tool's nose tells how high the surface is below it; each of its radii
/// with its slope over that height.
class BallRule
{
public:
  /// @param edgeLength  of the mesh [m]
  BallRule(const Tip& tip, double edgeLength) noexcept;

  [[nodiscard]] double nose() const noexcept
  {
    return nose_;
  }

  /// Radius of the contact, as the undeformed surface cuts it out of the tool; a sharp or flat end
  /// is inside the body, where a wider ball would reach a second wall long before the tool does.
  /// @param height  of the nose's center over the surface, negative inside [m]
  [[nodiscard]] Sloped contactRadius(double height) const noexcept;

  /// Radius over which the surface is smoothed [m].
  [[nodiscard]] Sloped smoothing(double height) const noexcept;

  /// Squared radius of the ball, Q [m^2].
  [[nodiscard]] Sloped operator()(double height) const noexcept
  {
    const auto [radius, slope] = smoothing(height);
    return { height * height + radius * radius, 2.0 * (height + radius * slope) };
  }

private:
  double nose_;
  double edge_;
  double steepness_ = 0.5; // of a sharp or flat end: contact by height, within bounds
  double least_ = 0.0;
  double most_ = 0.0;
};

} // namespace palp
