#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>

namespace palp
{

/// The part of a surface within a ball, summed up by integrals over its triangles.
///
/// Each changes smoothly with the ball, for what comes in at its rim weighs nothing there.
struct Patch
{
  double weight = 0.0;                              ///< of w = Q - q over the area [m^4]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< of w times the outward normal [m^4]
  Eigen::Vector3d square = Eigen::Vector3d::Zero(); ///< of w^2 times the outward normal [m^6]
  Eigen::Vector3d orientationSum =
    Eigen::Vector3d::Zero();      ///< as normal, with all triangles in full
  double orientationWeight = 0.0; ///< as weight, with all triangles in full
};

/// The part of a triangle within a ball.
struct DiscIntegral
{
  double weight = 0.0; ///< [m^4]
  double square = 0.0; ///< [m^6]
};

/// Weight of one triangle within a ball, and that of its square, in closed form.
///
/// With q the squared distance to the center and Q the squared radius, they are the integrals of
/// w = Q - q and of w^2. In the plane of the triangle the ball is a disc, and Green's theorem
/// leaves straight pieces and arcs.
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
/// @param fade    height behind a plane at which a triangle no longer counts [m], above 0
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Patch patchWithin(const Surface& surface, const Eigen::Vector3d& center,
  double radius, double side, double fade) noexcept;

} // namespace palp
