#pragma once

#include <Eigen/Core>

namespace palp
{

/// Where the tool is, in the frame of the surface.
struct ToolPose
{
  Eigen::Vector3d apex = Eigen::Vector3d::Zero();     ///< the end that touches first [m]
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();   ///< unit vector from handle to apex
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero(); ///< of the apex [m/s]
};

} // namespace palp
