#pragma once

#include "haptics/contact/overlap/tool_solid.h"
#include "haptics/pose.h"
#include "haptics/surface/surface.h"

#include <Eigen/Core>

namespace palp
{

/// A tool's own frame: from the apex, z up along the shaft.
struct ToolFrame
{
  explicit ToolFrame(const ToolPose& pose) noexcept;

  [[nodiscard]] Eigen::Vector3d place(const Eigen::Vector3d& inScene) const noexcept
  {
    return axes.transpose() * (inScene - apex);
  }

  Eigen::Vector3d apex; ///< [m]
  Eigen::Matrix3d axes; ///< a column each, in the scene
};

/// What a body and a tool have in common, by the part of the surface in the tool; in its frame.
///
/// By the divergence theorem, with the field of ToolSolid, the volume is a sum over that part, and
/// changes by its area as the tool moves. The normal is the mean of what faces the tool, by the
/// square of how much it does: the walls of an edge do not turn it.
struct Overlap
{
  bool isBeyond = false; ///< whether there is some of the surface beyond the shaft, too
  double volume = 0.0;   ///< [m^3]
  Eigen::Vector3d area = Eigen::Vector3d::Zero();       ///< of the outward normal: -d volume [m^2]
  double lift = 0.0;                                    ///< of it, over a flat at the apex [m^4]
  Eigen::Vector3d liftArea = Eigen::Vector3d::Zero();   ///< as area: -d lift [m^3]
  double weight = 0.0;                                  ///< of what faces the tool [m^2]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();     ///< of that, times the outward normal [m^2]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();      ///< and times the place [m^3]
  Eigen::Matrix3d placeSlope = Eigen::Matrix3d::Zero(); ///< of place, seen from where the tool was,
                                                        ///< as it moves; a column each [m^2]
  Eigen::Vector3d weightSlope = Eigen::Vector3d::Zero(); ///< as the tool moves [m]
  Eigen::Matrix3d normalSlope = Eigen::Matrix3d::Zero(); ///< likewise, a column each [m]
};

/// Past the border of an open sheet the volume is one that changes as smoothly.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Overlap overlapOf(
  const Surface& surface, const ToolSolid& solid, const ToolFrame& frame) noexcept;

} // namespace palp
