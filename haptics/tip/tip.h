#pragma once

#include <cmath>
#include <memory>
#include <variant>

namespace palp
{

class Profile; // haptics/tip/profile.h

/// Half-sphere; above its equator the tool is a shaft of the same radius. Fig. 2(a).
struct SphereTip
{
  double radius; ///< R [m], 0.1 mm to 1 m
};

/// Sharp cone; beyond the base radius the tool is a shaft. Fig. 2(b).
struct ConeTip
{
  double halfAngle;  ///< alpha [rad] between axis and flank, 1 to 89 degrees
  double baseRadius; ///< [m], 0.1 mm to 1 m, as in every tip
};

/// Flat-ended cylinder.
struct PunchTip
{
  double radius; ///< [m]
};

/// Cone cut off flat.
struct TruncatedConeTip
{
  double halfAngle;  ///< alpha [rad] between axis and flank
  double flatRadius; ///< [m], 1 um or more, smaller than the base
  double baseRadius; ///< [m]
};

/// Cone whose apex is a spherical cap tangent to the flank.
struct BluntConeTip
{
  double halfAngle;  ///< alpha [rad] between axis and flank
  double tipRadius;  ///< rho [m], 1 um or more, of the cap; the cap meets the flank at radius rho
                     ///< cos(alpha)
  double baseRadius; ///< [m], larger than rho cos(alpha)
};

/// Paraboloid r^2 / 2R up to radius R.
struct ParaboloidTip
{
  double radius; ///< R [m], radius of curvature at the apex and radius of the base
};

/// Any convex profile of revolution.
struct ProfileTip
{
  std::shared_ptr<const Profile> profile; ///< never null
};

/// A rigid tool base, axisymmetric about its axis; the apex is the end that touches first.
using Tip = std::variant<SphereTip, ConeTip, PunchTip, TruncatedConeTip, BluntConeTip,
  ParaboloidTip, ProfileTip>;

/// Calls function with the shape that a tip has.
///
/// By get_if for each shape in turn, because visit may throw and the servo thread may not.
///
/// @return    what function returns; for a variant that lost its value, a default
/// @realtime  as function
template <std::size_t Next = 0, typename Function>
auto onTip(const Tip& tip, Function function) noexcept -> decltype(function(SphereTip{}))
{
  if constexpr (Next < std::variant_size_v<Tip>)
  {
    const auto* shape = std::get_if<Next>(&tip);
    return shape != nullptr ? function(*shape) : onTip<Next + 1>(tip, function);
  }
  else
  {
    return {};
  }
}

/// Slope of a cone's flank.
/// @param angle  alpha [rad] between axis and flank
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] inline double cot(double angle) noexcept
{
  return 1.0 / std::tan(angle);
}

/// Radius of the shaft, which is also the largest contact radius.
/// @return    [m]
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] double baseRadius(const Tip& tip) noexcept;

/// Height of the tip's surface above its apex.
///
/// @param radius  distance from the axis [m], 0 to baseRadius(tip); beyond, the base's height
/// @return        f(r) [m], 0 at the axis, never decreasing
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] double tipHeight(const Tip& tip, double radius) noexcept;

/// Slope f'(r) of the tip's surface, for normals and tangents (L2 of Fig. 5).
/// @return        [-], finite: at a sphere's equator limited to 1e6
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] double tipSlope(const Tip& tip, double radius) noexcept;

/// Radius of the flat that touches first [m]; 0 where the apex is a point.
[[nodiscard]] double flatRadius(const Tip& tip) noexcept;

/// Radius of the ball that meets a smooth body first [m]; 0 where the tip is sharp or flat.
[[nodiscard]] double noseRadius(const Tip& tip) noexcept;

/// Checks every dimension of a tip.
/// @throws Error  BadValue: names the dimension, its range and what to give
[[nodiscard]] Tip checkedTip(Tip tip);

} // namespace palp
