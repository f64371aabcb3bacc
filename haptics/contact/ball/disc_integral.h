#pragma once

#include "haptics/contact/ball/rim_angle.h"
#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>

namespace palp
{

/// The part of a triangle within a ball: integrals of 1 and of w = Q - q.
struct DiscIntegral
{
  double area = 0.0;   ///< [m^2]
  double weight = 0.0; ///< [m^4]
  double rim = 0.0;    ///< of the ball's rim: d area / d Q [-]
  Eigen::Vector3d slope =
    Eigen::Vector3d::Zero(); ///< of the weight, as the center moves at the same radius [m^3]
};

/// What of one triangle lies within a ball, in closed form.
///
/// With q the squared distance to the center and Q the squared radius. In the plane of the triangle
/// the ball is a disc, and Green's theorem leaves straight pieces and arcs.
///
/// @param facet          with its unit normal
/// @param center         of the ball [m]
/// @param squaredRadius  Q [m^2], above 0
/// @param rim            where the triangle leaves the ball is added to it
/// @realtime             pure but for that; no allocation, no lock, no exception
[[nodiscard]] DiscIntegral integrate(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius, RimAngle& rim) noexcept;

/// The solid angle of the same part, seen from the center of the ball [rad^2].
/// @param squaredRadius  Q [m^2], above 0
/// @realtime             pure; no allocation, no lock, no exception
[[nodiscard]] double solidAngleOf(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept;

/// By how much the change of what one triangle adds to the moment and the volume of a body is more
/// than -weight and -area times its normal, as the center of the ball moves: integrals along its
/// sides within the ball, which cancel between triangles that are joined there.
struct SeamIntegral
{
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(); ///< [m^4]
  Eigen::Vector3d volume = Eigen::Vector3d::Zero(); ///< d moment / d Q [m^2]
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();    ///< d volume / d Q [-]
};

/// @param squaredRadius  Q [m^2], above 0
/// @param sides          that count: bit k, of that from corner k
/// @realtime             pure; no allocation, no lock, no exception
[[nodiscard]] SeamIntegral seamsOf(const Facet& facet, const Eigen::Vector3d& center,
  double squaredRadius, std::uint8_t sides = 0b111) noexcept;

} // namespace palp
