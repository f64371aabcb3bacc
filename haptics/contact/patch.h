#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>

namespace palp
{

/// The part of a surface within a ball, summed up by integrals over its triangles.
///
/// Each changes smoothly with the ball, for what comes in at its rim weighs nothing there. By the
/// divergence theorem the body's moment is a sum over its triangles, too, and -normal its slope as
/// the ball moves: a radial field of divergence w, x (2 Q / 15 + w / 5) - 2 Q^2.5 / 15 x / q^1.5,
/// vanishes on the ball, and its last term is the solid angle of a triangle.
struct Patch
{
  double weight = 0.0;                              ///< of w = Q - q over the area [m^4]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< of w times the outward normal [m^4]
  Eigen::Vector3d area = Eigen::Vector3d::Zero();   ///< of the outward normal [m^2]
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();    ///< d area / d Q [-]
  double moment = 0.0;                              ///< of w over the body within the ball [m^5]
  double volume = 0.0;                              ///< of the same: d moment / d Q [m^3]
  double solidAngle = 0.0;      ///< of the ball's sphere within the body [rad^2]
  double solidAngleSlope = 0.0; ///< over Q [rad^2/m^2]
  Eigen::Vector3d fading = Eigen::Vector3d::Zero(); ///< -d moment by what fades out [m^4]
  Eigen::Vector3d orientationSum =
    Eigen::Vector3d::Zero();      ///< as normal, with all triangles in full
  double orientationWeight = 0.0; ///< as weight, with all triangles in full
};

/// The part of a triangle within a ball.
struct DiscIntegral
{
  double area = 0.0;       ///< [m^2]
  double weight = 0.0;     ///< [m^4]
  double rim = 0.0;        ///< of the ball's rim: d area / d Q [-]
  double solidAngle = 0.0; ///< seen from the center of the ball [rad^2]
};

/// What of one triangle lies within a ball, in closed form.
///
/// With q the squared distance to the center and Q the squared radius, they are the integrals of
/// 1 and of w = Q - q, with the solid angle. In the plane of the triangle the ball is a disc, and
/// Green's theorem leaves straight pieces and arcs.
///
/// @param facet          with its unit normal
/// @param center         of the ball [m]
/// @param squaredRadius  Q [m^2], above 0
/// @realtime             pure; no allocation, no lock, no exception
[[nodiscard]] DiscIntegral integrate(
  const Facet& facet, const Eigen::Vector3d& center, double squaredRadius) noexcept;

/// Sums the triangles within a ball, those that face its center in full.
///
/// Triangles that turn their back fade out with the distance of the center behind their plane, so
/// that the far side of a thin lobe does not count.
///
/// @param radius  of the ball [m], above 0
/// @param side    1: the center is well outside the body, -1: well inside; between, both sides
///                count
/// @param isInside  the center is inside the body
/// @param fade    height behind a plane at which a triangle no longer counts [m], above 0
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Patch patchWithin(const Surface& surface, const Eigen::Vector3d& center,
  double radius, double side, double fade, bool isInside) noexcept;

} // namespace palp
