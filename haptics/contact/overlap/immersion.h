#pragma once

#include "haptics/contact/overlap/tool_solid.h"

#include <Eigen/Core>

namespace palp
{

/// How deep a tool is in a smooth body with which it has as much in common, and how that changes.
struct Immersion
{
  static constexpr double kClose = 1e-12; ///< within which a depth is found [m]

  double depth = 0.0;                                 ///< of the apex, or the middle of a flat [m]
  double byVolume = 0.0;                              ///< [1/m^2]
  double byLift = 0.0;                                ///< [1/m^3]
  double byCurvature = 0.0;                           ///< [m^2]
  Eigen::Vector3d byNormal = Eigen::Vector3d::Zero(); ///< [m]
  double area = 0.0;                                  ///< of the body's surface in the tool [m^2]
  Eigen::Vector3d aside = Eigen::Vector3d::Zero();    ///< its middle, from the foot of the apex [m]
};

/// Of a pointed tool: the body is a half-space, with as much of a paraboloid on it as the rim of
/// its surface in the tool encloses.
///
/// @param normal     outward, of unit length, in the tool's frame
/// @param volume     above 0 [m^3]
/// @param start      a depth that is near [m]
/// @param curvature  mean, convex positive [1/m]; leveled off where the body is rounder than what
///                   of the tool is in it
/// @realtime         pure; no allocation, no lock, no exception
[[nodiscard]] Immersion immersionOf(const ToolSolid& solid, const Eigen::Vector3d& normal,
  double volume, double start, double curvature) noexcept;

} // namespace palp
