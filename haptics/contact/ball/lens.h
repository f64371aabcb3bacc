#pragma once

namespace palp
{

/// What a ball and a smooth body have in common, as a Patch tells of a mesh.
struct Lens
{
  double moment;          ///< of w = Q - q over the body within the ball [m^5]
  double volume;          ///< of the same: d moment / dQ [m^3]
  double solidAngle;      ///< of the ball's sphere within the body, from its center [rad^2]
  double solidAngleSlope; ///< over Q [rad^2/m^2]
  double heightSlope;     ///< d moment / d height [m^4]
  double curvatureSlope;  ///< d moment / d curvature [m^6]
};

/// A body bounded by a sphere or a plane, within a ball of the squared radius Q, by integrals over
/// spheres about the ball's center, of which the body holds the part 1 - (k q + b) / (c sqrt(q)).
///
/// @param height     of the ball's center over the surface [m], negative inside; its square below Q
/// @param curvature  k of the surface [1/m], convex positive; 1 + k height above 0
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] Lens lensOf(double squaredRadius, double height, double curvature) noexcept;

} // namespace palp
