#pragma once

#include "haptics/contact/contact.h"
#include "haptics/numerics/smooth_step.h"
#include "haptics/pose.h"
#include "haptics/surface/surface.h"
#include "haptics/tip/tip.h"

#include <Eigen/Core>

namespace palp
{

/// What a body's normals below a tool sum up to, and how that changes as the tool moves.
struct NormalSum
{
  Eigen::Vector3d value; ///< shorter than the weight, the more they differ
  Eigen::Matrix3d slope; ///< a column for each way to move [1/m]
  double weight;
  Eigen::Vector3d weightSlope; ///< [1/m]

  /// Of the normals about their mean: what that is shorter than they [-].
  [[nodiscard]] double spread() const noexcept
  {
    return 1.0 - value.norm() / weight;
  }
  /// How the length of the mean changes as the tool moves [1/m].
  [[nodiscard]] Eigen::Vector3d shareSlope() const noexcept;
};

/// What is below a tool, and how that changes as the tool moves.
struct ShapeBall
{
  Eigen::Vector3d center;                               ///< [m]
  double radius;                                        ///< [m]
  Eigen::Vector3d normal;                               ///< of the body there, of unit length
  Eigen::Vector3d widening = Eigen::Vector3d::Zero();   ///< of the radius [-]
  Eigen::Matrix3d moving = Eigen::Matrix3d::Identity(); ///< of the center, a column for each way
  Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();    ///< of the normal, likewise [1/m]
};

/// The radius of a contact, or the least over which the shape of a surface is smooth.
/// @param contact  [m]
/// @realtime       pure; no allocation, no lock, no exception
[[nodiscard]] Sloped shapeRadius(
  const Surface& surface, const Tip& tip, const Sloped& contact) noexcept;

/// The mean normal of the body, and how the tool is tilted to it as that turns with the body.
/// @realtime  pure; no allocation, no lock, no exception
void measureNormal(Contact& contact, const ToolPose& pose, const NormalSum& normals) noexcept;

/// What of the body counts as the shape of the contact, and how that changes as the tool moves.
/// @realtime  pure; no allocation, no lock, no exception
void measureShape(Contact& contact, const Surface& surface, const Tip& tip, const ShapeBall& ball,
  CurvatureOf of) noexcept;

} // namespace palp
