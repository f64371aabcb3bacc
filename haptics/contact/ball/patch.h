#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>

namespace palp
{

/// How normal and weight of a patch change as the center moves, in the same ball.
struct PatchSlopes
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero(); ///< a column for each way to move [m^3]
  Eigen::Vector3d weight = Eigen::Vector3d::Zero(); ///< [m^3]
  double area = 0.0;                                ///< d weight / d Q [m^2]
};

/// The same over the turning of the ball.
struct PatchTurns
{
  double moment = 0.0;                              ///< [m^6]
  double volume = 0.0;                              ///< [m^4]
  double weight = 0.0;                              ///< [m^5]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< [m^5]
};

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
  Eigen::Vector3d rim = Eigen::Vector3d::Zero();    ///< d (area + volumeFading) / d Q [-]
  double moment = 0.0;                              ///< of w over the body within the ball [m^5]
  double volume = 0.0;                              ///< of the same: d moment / d Q [m^3]
  double solidAngle = 0.0;      ///< of the ball's sphere within the body [rad^2]
  double solidAngleSlope = 0.0; ///< over Q [rad^2/m^2]
  /// -d moment by what fades out, and by what comes in at the border of an open sheet [m^4].
  Eigen::Vector3d fading = Eigen::Vector3d::Zero();
  Eigen::Vector3d volumeFading = Eigen::Vector3d::Zero(); ///< -d volume by the same [m^2]
  Eigen::Vector3d orientationSum =
    Eigen::Vector3d::Zero();      ///< as normal, with all triangles in full
  double orientationWeight = 0.0; ///< as weight, with all triangles in full
  bool isOpen = false;            ///< whether the border of a sheet is within the ball
  PatchSlopes slopes{};
  PatchTurns turns{};
};

/// What of a surface is summed, and how.
struct PatchBall
{
  Eigen::Vector3d center; ///< [m]
  double radius;          ///< [m], above 0
  double turning; ///< how much less a triangle counts the higher its plane is over the center
                  ///< [1/m]; negative where that is inside the body; 0: all count
};

/// Sums the triangles within a ball, those that face its center in full.
///
/// Triangles that turn their back fade out with the distance of the center behind their plane, so
/// that the far side of a thin lobe does not count.
///
/// @param inside  how far the center is inside the body [-]: 0 or 1, but for between beside an open
///                edge
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Patch patchWithin(
  const Surface& surface, const PatchBall& ball, double inside) noexcept;

} // namespace palp
