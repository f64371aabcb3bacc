#pragma once

#include <Eigen/Core>
#include <limits>

namespace palp
{

/// Contact of a tool with the undeformed surface.
struct Contact
{
  double depth = 0.0;                               ///< delta [m]; 0 when apart
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< outward unit normal; zero when apart
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< on the undeformed surface [m]
  double tilt = 0.0;                                ///< tool axis to -normal [rad]
  int triangle = -1;                                ///< below the center; -1 when apart
  double surfaceCurvature = 0.0;                    ///< mean, 1/R0 [1/m], convex positive
  double curvatureSpread = 0.0;                     ///< half the difference [1/m]
  double curvedPart = 1.0; ///< of these that is below the tool, not at an edge beside [-]
  double thickness = std::numeric_limits<double>::infinity(); ///< of the body below [m]
  double hollow = 0.0; ///< part of what lies around above a hollow within the body [-]
  double edgeDistance = std::numeric_limits<double>::infinity(); ///< to an open or sharp edge [m]
  double normalSpread = 0.0; ///< of the normals below the tool about their mean, rms [rad]
  double relief = 0.0;       ///< of the nearest place over the even surface it is taken as [m]

  double slope = 1.0; ///< of depth against the normal, as the tool moves along; 1 on a plane [-]
  Eigen::Vector3d curvatureSlope =
    Eigen::Vector3d::Zero(); ///< of surfaceCurvature as the tool moves [1/m^2]
  Eigen::Vector3d spreadSlope = Eigen::Vector3d::Zero();    ///< of curvatureSpread [1/m^2]
  Eigen::Vector3d thicknessSlope = Eigen::Vector3d::Zero(); ///< of thickness [-]
  Eigen::Vector3d tiltSlope = Eigen::Vector3d::Zero();      ///< of tilt [rad/m]
  Eigen::Vector3d bodyNormal =
    Eigen::Vector3d::Zero(); ///< mean outward normal below the tool, of unit length
  Eigen::Matrix3d turning =
    Eigen::Matrix3d::Zero(); ///< of that, a column for each way to move [1/m]
  double height = 0.0;       ///< of the tool's reference point over the surface [m]
  Eigen::Vector3d rising = Eigen::Vector3d::Zero(); ///< of that as the tool moves [-]

  [[nodiscard]] bool touching() const noexcept
  {
    return depth > 0.0;
  }
};

} // namespace palp
