#pragma once

#include "haptics/contact/overlap/tool_solid.h"

#include <Eigen/Core>

namespace palp
{

/// What a half-space has in common with a tool.
struct Section
{
  double volume = 0.0;                               ///< [m^3]
  double area = 0.0;                                 ///< of its surface: d volume / d height [m^2]
  double growth = 0.0;                               ///< d area / d height [m]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< of the surface, from the foot of the apex
                                                     ///< [m^3]; -d volume as the normal turns
  Eigen::Vector3d growing = Eigen::Vector3d::Zero(); ///< -d area as the normal turns [m^2]
};

/// @param normal  of the half-space, unit length, in the tool's frame
/// @param height  of its surface over the apex, along the normal [m]
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Section sectionOf(
  const ToolSolid& solid, const Eigen::Vector3d& normal, double height) noexcept;

} // namespace palp
