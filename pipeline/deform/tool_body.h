#pragma once

#include "haptics/pose.h"
#include "haptics/tip/tip.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace palp
{

/// The tool as a convex body in space: its tip, and above the base a shaft without end.
class ToolBody
{
public:
  /// @param tip   checked
  /// @param pose  axis of unit length
  ToolBody(const Tip& tip, const ToolPose& pose);

  /// How deep a point is: positive inside, zero on the surface, negative outside.
  ///
  /// A concave function of the position; near the surface within a factor of the distance.
  /// @return [m]
  [[nodiscard]] double inside(const Eigen::Vector3d& point) const noexcept;

  /// Whether a point is inside, at a fraction of the cost.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point) const noexcept
  {
    const Eigen::Vector3d fromApex = point - apex_;
    const double height = fromApex.dot(handle_);
    const double square = fromApex.squaredNorm() - height * height;
    if (!(height > 0.0) || !(square < base_ * base_))
    {
      return false;
    }
    return sphere_ > 0.0 ? height > sphere_ || square + height * height < 2.0 * sphere_ * height
                         : height > heightAt(std::sqrt(std::max(0.0, square)));
  }

  /// Where a line enters the tool, coming from below.
  ///
  /// @param origin  of the line [m]
  /// @param up      unit vector, less than 90 degrees from apex to handle
  /// @return        t [m] of origin + t up, never inside the tool; infinite when the line misses
  [[nodiscard]] double lowest(
    const Eigen::Vector3d& origin, const Eigen::Vector3d& up) const noexcept;

  /// How far the rim of the base is along a line, seen along another.
  ///
  /// @param origin   of the line [m]
  /// @param towards  unit vector of it
  /// @param up       as of lowest()
  /// @return         t [m] of origin + t towards, the larger of two; 0 where the line passes by
  [[nodiscard]] double rim(const Eigen::Vector3d& origin, const Eigen::Vector3d& towards,
    const Eigen::Vector3d& up) const noexcept;

  /// Distance of a point from the axis [m].
  [[nodiscard]] double fromAxis(const Eigen::Vector3d& point) const noexcept
  {
    return (point - apex_).cross(handle_).norm();
  }

  /// Radius of the shaft [m].
  [[nodiscard]] double base() const noexcept
  {
    return base_;
  }

  /// Radius of the flat end [m], 0 for other tips.
  [[nodiscard]] double flat() const noexcept
  {
    return flat_;
  }

  /// Whether the tip is flat up to its base.
  [[nodiscard]] bool hasFlatBase() const noexcept
  {
    return flat_ >= base_;
  }

  /// Whether the slope of the tip may leap.
  [[nodiscard]] bool hasCorners() const noexcept
  {
    return std::holds_alternative<TruncatedConeTip>(tip_) ||
      std::holds_alternative<ProfileTip>(tip_);
  }

private:
  [[nodiscard]] double heightAt(double radius) const noexcept
  {
    return flank_ > 0.0 ? flank_ * radius : tipHeight(tip_, radius);
  }
  [[nodiscard]] double march(double start, double height, double climb,
    const Eigen::Vector3d& radial, const Eigen::Vector3d& drift) const noexcept;

  Tip tip_;
  Eigen::Vector3d apex_;
  Eigen::Vector3d handle_; // unit vector from apex to handle
  double base_;            // [m]
  double flat_;            // [m]
  double sphere_;          // radius of a spherical tip [m], 0 for other tips
  double flank_;           // slope of a sharp cone [-], 0 for other tips
};

/// The way that a surface goes below a tool: against the contact's normal, unless a straight flank,
/// the rim of a profile or the shaft of a tool that leans would stand along it as a wall; then as
/// near to it as leaves 12 degrees between them.
///
/// @param normal  unit
/// @param axis    of the tool, unit
/// @return        unit, in the plane of both
[[nodiscard]] Eigen::Vector3d drawnNormal(
  const Eigen::Vector3d& normal, const Eigen::Vector3d& axis, const Tip& tip);

} // namespace palp
