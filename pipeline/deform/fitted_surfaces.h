#pragma once

#include "calibration/tables/surface_profile.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// The fitted surfaces of one tool over the depth, as `data/tables/*_surface.csv` lists them.
class FittedSurfaces
{
public:
  static constexpr std::size_t kColumns = 7;

  /// Reads such a table.
  /// @param scale   of all lengths: for a tool and layer that many times as large [-]
  /// @param deepest rows of more depth are not used [m]
  /// @throws Error  BadFile: missing, or not seven numbers a row; BadValue: as below
  [[nodiscard]] static FittedSurfaces read(const std::filesystem::path& file, double scale = 1.0,
    double deepest = std::numeric_limits<double>::infinity());

  /// @param rows    depth_mm,inner_mm,outer_mm,sink_mm,slope,control_outer_mm,control_inner_mm;
  ///                depths increasing
  /// @throws Error  BadValue: fewer than two rows, other columns, or depths not increasing
  explicit FittedSurfaces(const std::vector<std::vector<double>>& rows);

  /// Linear between the rows; below the first the sink is in proportion to the depth, and the
  /// contact follows the power of it that leads to the second row. Beyond the last row the contact
  /// stays as it was there, and everything sinks with the tool: by how much follows the sink at the
  /// contact. What sinks by less than a hundredth of the depth is at rest.
  ///
  /// @param depth  delta [m]
  [[nodiscard]] std::optional<SurfaceProfile> at(double depth) const noexcept;

  /// Depth of the last row [m].
  [[nodiscard]] double deepest() const noexcept
  {
    return rows_.back().depth;
  }

private:
  struct DepthProfile
  {
    double depth; // [m]
    SurfaceProfile profile;
  };

  [[nodiscard]] SurfaceProfile profileAt(double depth) const noexcept;
  [[nodiscard]] SurfaceProfile shallower(double fraction) const noexcept;

  std::vector<DepthProfile> rows_;
};

} // namespace palp
