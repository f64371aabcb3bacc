#pragma once

#include "haptics/force/linear/half_space.h"
#include "haptics/numerics/roots.h"
#include "haptics/numerics/smooth_step.h"
#include "haptics/tip/tip.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{

/// Control points P_ij of one patch, i = 0..2 outwards from the tool, j = 0..1 around it.
using PatchNet = std::array<std::array<Eigen::Vector3d, 2>, 3>;

/// A point of a Bezier patch of degree 2 x 1.
///
/// @param u  0 on the contact circle to 1 on the circle of radius R_d
/// @param v  0 to 1 around
/// @source   Eq. (8)
[[nodiscard]] inline Eigen::Vector3d patchPoint(const PatchNet& net, double u, double v) noexcept
{
  const std::array<double, 3> along{ (1.0 - u) * (1.0 - u), 2.0 * u * (1.0 - u), u * u };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < along.size(); ++i)
  {
    sum += along[i] * ((1.0 - v) * net[i][0] + v * net[i][1]);
  }
  return sum;
}

/// The boundary curve of the ring's patches in the plane of Fig. 5(b).
///
/// Lengths are taken along the undeformed surface and sinks below it, so that L1 is the surface
/// itself: P0 = (inner, sink), P1 = (meet, 0), P2 = (outer, 0).
struct RingCurve
{
  double inner; ///< contact radius r [m]
  double sink;  ///< of P0 on the tool below the undeformed surface [m], 0 or more
  double meet;  ///< where L1 and L2 meet [m], inner to outer
  double outer; ///< R_d of the ring [m]

  /// Depth of the ring below the undeformed surface.
  ///
  /// @param radius  distance from the contact's center [m]; inside the inner circle on L2
  /// @return        [m], 0 beyond the outer circle
  [[nodiscard]] double sinkAt(double radius) const noexcept
  {
    if (!(radius < outer))
    {
      return 0.0;
    }
    const double first = meet - inner;
    if (radius < inner)
    {
      return first > 0.0 ? sink * (1.0 + (inner - radius) / first) : sink;
    }
    // radius(u) = inner + 2 u (meet - inner) + u^2 (inner - 2 meet + outer), and v = 1 - u
    const double bend = (outer - meet) - first;
    const double rise = radius - inner;
    const double root = std::sqrt(std::max(0.0, first * first + bend * rise));
    const double u = rise > 0.0 ? rise / (first + root) : 0.0;
    return sink * (1.0 - u) * (1.0 - u);
  }
};

/// The curve of a tool that leaves the surface at a known angle.
///
/// Where L1 and L2 do not meet between the circles P1 stays on L1 at the nearer one; for a slope
/// of zero or less they do not meet ahead of the tool, and P1 is on the outer circle.
///
/// @param slope  of the tool over the undeformed surface at the inner circle, outwards [-]
[[nodiscard]] inline RingCurve makeRingCurve(
  double inner, double sink, double slope, double outer) noexcept
{
  const double sunk = std::max(0.0, sink);
  const double reach = slope > 0.0 ? sunk / slope : outer;
  return { inner, sunk, std::clamp(inner + reach, inner, std::max(inner, outer)), outer };
}

/// Contact radius as drawn.
///
/// Up to half a sphere's radius deep the law's, from there on more and more that of the exact
/// sphere: r = sqrt(R delta) would reach the equator at delta = R, where the tangent is vertical
/// and the sink of the ring none. From delta = R on never more than the exact sphere's.
///
/// @param depth      delta [m]
/// @param lawRadius  r of the law [m]
/// @source           Sneddon 1965: delta = (a / 2) ln((R + a) / (R - a)), a = 0.834 R at delta = R
[[nodiscard]] inline double drawnContactRadius(
  const Tip& tip, double depth, double lawRadius) noexcept
{
  const auto* sphere = std::get_if<SphereTip>(&tip);
  if (sphere == nullptr || !(depth > 0.5 * sphere->radius))
  {
    return lawRadius;
  }
  const double most = std::min(lawRadius, HalfSpace(tip)(depth).radius);
  return std::lerp(lawRadius, most, smoothStep(2.0 * depth / sphere->radius - 1.0));
}

/// Least outer radius of a ring whose tangents L1 and L2 meet at a distance from its center.
///
/// Just outside: within that circle an undisturbed surface would be inside the tool. Where flanks
/// are almost level three contact radii are enough.
///
/// @param meet           [m]
/// @param contactRadius  r [m]
[[nodiscard]] inline double ringRadiusFor(double meet, double contactRadius) noexcept
{
  constexpr double kOutside = 1.05;
  constexpr double kMost = 3.0;
  return std::min(kOutside * meet, kMost * contactRadius);
}

/// Outer radius of the ring as drawn, on a plane.
///
/// R_d of the table is the radius of a certain sink, and at small depths it lies inside the
/// contact. The ring then ends at 1.2 r or, where the tool itself reaches further, at
/// ringRadiusFor(). The largest of the three is continuous in the depth.
///
/// @param tip            checked
/// @param depth          delta [m]
/// @param contactRadius  r [m]
/// @param extentRadius   R_d of the table [m]
/// @return               [m]
[[nodiscard]] inline double ringRadius(
  const Tip& tip, double depth, double contactRadius, double extentRadius) noexcept
{
  constexpr double kLeast = 1.2; // [-] of the contact radius
  const double slope = tipSlope(tip, contactRadius);
  const double sink = std::max(0.0, depth - tipHeight(tip, contactRadius));
  double meet = slope > 0.0 ? contactRadius + sink / slope : 0.0;
  if (std::holds_alternative<ProfileTip>(tip))
  {
    // its tangent may turn at once, and the ring would draw back
    const auto isBelow = [&](double radius) { return tipHeight(tip, radius) < depth; };
    meet = bisect(isBelow, { 0.0, baseRadius(tip) }, 30).high;
  }
  return std::max({ extentRadius, kLeast * contactRadius, ringRadiusFor(meet, contactRadius) });
}

} // namespace palp
