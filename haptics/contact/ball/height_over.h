#pragma once

#include "haptics/contact/ball/ball_rule.h"
#include "haptics/contact/ball/patch.h"

#include <Eigen/Core>

namespace palp
{

/// Of the center of a tool's nose over the surface that the facets stand for.
struct Height
{
  double value;          ///< [m], negative inside
  Eigen::Vector3d slope; ///< over the place of the center; of length 1 on planes and spheres [-]
};

/// The height at which a smooth body would have as much in common with the ball as the mesh has, by
/// the moment of Q - q, with the ball that belongs to this height.
///
/// As the ball moves, that moment changes by its patch's normal, so the slope is as smooth as the
/// mean normal, and is that of the height: work over a closed way is none. From the given ball to
/// its own the moment is taken by three orders in Q, which are exact on planes and spheres.
class HeightOver
{
public:
  /// @param patch    within that ball; outlives this object, as rule does
  /// @param nearest  signed distance of the nearest point [m]
  /// @param given    the ball that belongs to it by the rule
  HeightOver(
    const Patch& patch, const BallRule& rule, double nearest, const BallSize& given) noexcept;

  /// @param start           a height that is near, as of another curvature [m]
  /// @param curvature       of the smooth body [1/m], convex positive
  /// @param curvatureSlope  over the place of the center [1/m^2]
  /// @realtime              pure; no allocation, no lock, no exception
  [[nodiscard]] Height operator()(
    double start, double curvature, const Eigen::Vector3d& curvatureSlope) const noexcept;

private:
  // what the mesh has more than a body of a height, in the ball of that height
  struct Excess
  {
    double value;  // [m^5]
    double byQ;    // [m^3]
    double fall;   // of it with the height, in the same ball [m^4]
    double growth; // of Q with the height [m]
    double more;   // Q of that ball beyond the given [m^2]

    [[nodiscard]] double byHeight(double fallThere) const noexcept;
  };

  [[nodiscard]] Excess excessAt(double height, double curvature) const noexcept;

  const Patch* patch_;
  const BallRule* rule_;
  double nearest_;
  double smoothing_;          // radius [m]
  double given_;              // Q [m^2]
  double ball_;               // radius [m]
  Eigen::Vector3d ballSlope_; // of that as the center moves [-]
  double leastMore_; // Q of the smallest ball that has any of the mesh, beyond the given [m^2]
  double part_;      // of the moment that counts [-]
  double moment_;    // [m^5]
};

} // namespace palp
