#pragma once

#include "haptics/numerics/smooth_step.h"
#include "haptics/tip/tip.h"

namespace palp
{

/// A ball about a tool's round nose; slopes are over the height of the nose.
struct BallSize
{
  Sloped smoothing; ///< radius over which the surface is smoothed [m]
  Sloped squared;   ///< Q, the square of its own radius [m^2]
};

/// How large a ball about a tool's round nose tells how high the surface is below it.
class BallRule
{
public:
  /// @param edgeLength   of the mesh [m]
  /// @param facetLength  of its edges that stand for what is round [m]
  BallRule(const Tip& tip, double edgeLength, double facetLength) noexcept;

  [[nodiscard]] double nose() const noexcept
  {
    return nose_;
  }

  /// Radius of the contact, as the undeformed surface cuts it out of the ball.
  /// @param height  of the nose's center over the surface, negative inside [m]
  [[nodiscard]] Sloped contactRadius(double height) const noexcept;

  [[nodiscard]] BallSize operator()(double height) const noexcept;

private:
  double nose_;
  double edge_;
  double facet_;
};

} // namespace palp
