#pragma once

#include "pipeline/deform/local_quadric.h"
#include "pipeline/deform/press_region.h"
#include "pipeline/deform/tool_body.h"

#include <Eigen/Core>

namespace palp
{

/// How far a tool is above the undeformed surface along one way from the contact's center.
///
/// Radii are seen along the contact's normal [m].
class ToolGap
{
public:
  /// @param towards  unit vector in the tangent plane
  ToolGap(const LocalQuadric& surface, const PressRegion& region, const ToolBody& body,
    const Eigen::Vector2d& towards) noexcept;

  /// Less than zero where the tool is pressed in; infinite where a tool whose tip is below the
  /// center has its shaft, which leans over the surface by next to nothing [m].
  [[nodiscard]] double operator()(double radius) const noexcept;

  /// Where the tool leaves the surface, or its base ends below it.
  ///
  /// @param atCenter  the gap at radius 0, less than 0 [m]
  [[nodiscard]] double exit(double atCenter) const noexcept;

  /// Where contact ends before an edge of the tool, which may be the exit.
  ///
  /// Before the tool leaves the surface at an angle. An edge below the surface is reached by and
  /// by, as if the tool went on as it rises to there, for no place may come up as the tool sinks.
  [[nodiscard]] double contactBefore(double edge) const noexcept;

  /// The edge of the tool's flat, the end at most; 0 for tools without one.
  [[nodiscard]] double flatEdge(double end) const noexcept;

  /// Radius at which the gap is a height, the end at most.
  [[nodiscard]] double radiusAt(double height, double end) const noexcept;

  /// Slope with which the surface leaves the tool [-].
  [[nodiscard]] double slopeAt(double contact, double exit) const noexcept;

private:
  [[nodiscard]] Eigen::Vector3d foot(double radius) const noexcept
  {
    return center_ + radius * outwards_;
  }
  [[nodiscard]] double fromAxis(double radius) const noexcept;

  const LocalQuadric& surface_;
  const ToolBody& body_;
  Eigen::Vector2d towards_;
  Eigen::Vector3d normal_;
  Eigen::Vector3d center_;
  Eigen::Vector3d outwards_;
  bool onTip_;
};

} // namespace palp
