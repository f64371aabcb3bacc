#pragma once

#include "calibration/surface_profile.h"

#include <filesystem>
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
  /// @throws Error  BadFile: missing, or not seven numbers a row; BadValue: as below
  [[nodiscard]] static FittedSurfaces read(const std::filesystem::path& file, double scale = 1.0);

  /// @param rows    depth_mm,inner_mm,outer_mm,sink_mm,slope,control_outer_mm,control_inner_mm;
  ///                depths increasing
  /// @throws Error  BadValue: fewer than two rows, other columns, or depths not increasing
  explicit FittedSurfaces(const std::vector<std::vector<double>>& rows);

  /// Linear between the rows, in proportion to the depth below the first; nothing at 0 and beyond
  /// the last row.
  ///
  /// @param depth  delta [m]
  [[nodiscard]] std::optional<SurfaceProfile> at(double depth) const noexcept;

private:
  struct Row
  {
    double depth; // [m]
    SurfaceProfile profile;
  };

  std::vector<Row> rows_;
};

} // namespace palp
