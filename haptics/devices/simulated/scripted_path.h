#pragma once

#include "haptics/pose.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// Where the tool is at one moment of a path.
struct PathKnot
{
  double time = 0.0;                              ///< [s]
  Eigen::Vector3d apex = Eigen::Vector3d::Zero(); ///< in the frame of the surface [m]
  std::optional<Eigen::Vector3d> axis{};          ///< unit, from handle to apex; none: caller's
};

/// Motion of a tool through given points, linear in between.
class ScriptedPath
{
public:
  /// @param knots   at least one; times increase by 1 us or more; apexes within 10 m; axes unit
  /// @throws Error  BadValue: a knot that breaks this, by its number
  explicit ScriptedPath(std::vector<PathKnot> knots);

  /// Pose at a time of the path; before its start and after its end the tool rests there.
  ///
  /// The velocity is that of the piece which begins at the time, at the end of the last one.
  ///
  /// @param time         [s]
  /// @param missingAxis  unit vector that stands in where a knot has no axis
  /// @realtime           pure; no allocation, no lock, no exception
  [[nodiscard]] ToolPose poseAt(double time, const Eigen::Vector3d& missingAxis) const noexcept;

  [[nodiscard]] std::span<const PathKnot> knots() const noexcept
  {
    return knots_;
  }

  /// True when every knot has an axis, so that no other is needed.
  [[nodiscard]] bool hasAxes() const noexcept;

  [[nodiscard]] double startTime() const noexcept
  {
    return knots_.front().time;
  }

  /// Time from the first knot to the last [s].
  [[nodiscard]] double duration() const noexcept
  {
    return knots_.back().time - knots_.front().time;
  }

private:
  std::vector<PathKnot> knots_;
};

/// Path from the text of a CSV file `time_s,x_mm,y_mm,z_mm[,ax,ay,az]`, or of an exported
/// samples.csv, whose tool_x_mm to axis_z are found by name among its other columns. Where such a
/// recording leaves samples out between two without contact, the tool stays and then appears.
/// Of two hands the first one's rows are taken.
///
/// Names and words may stand in quotes. The header row of a path may be absent; lines that start
/// with # and empty lines are skipped. The decimal point is a point in every locale. An axis is
/// made exactly one long when it is so within 1 %.
///
/// @param text    whole file
/// @param name    stands before each message
/// @throws Error  BadFile: name, line, what is wrong with it and what it should be
[[nodiscard]] ScriptedPath parsePath(std::string_view text, const std::string& name);

/// Path from a CSV file; see parsePath.
/// @throws Error  BadFile: unreadable, or as parsePath
[[nodiscard]] ScriptedPath readPath(const std::filesystem::path& file);

} // namespace palp
