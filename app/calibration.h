#pragma once

#include "app/press_options.h"
#include "calibration/extent_table.h"
#include "pipeline/fitted_surfaces.h"

#include <optional>
#include <string>

namespace palp
{

/// How the surface gives way around a tool, as found by finite elements.
struct Calibration
{
  ExtentTable extents;                    ///< R_d(depth), for the paper's ring
  std::optional<FittedSurfaces> surfaces; ///< to follow instead of that ring; none: the paper's
  std::string note;                       ///< what stands in for what, for the user; or empty

  /// The table has a row as deep as that; beyond, its last R_d.
  [[nodiscard]] bool covers(double depth) const noexcept
  {
    return depth <= extents.rows().back().depth;
  }
};

/// The table that the options name, the paper's two spheres and cones as they are, any other sphere
/// from its dimensionless surface.
///
/// @throws Error  BadFile; BadValue: --layer or --threshold with a tool whose table has them fixed
[[nodiscard]] Calibration loadCalibration(const PressOptions& options, const ForceLaw& law);

} // namespace palp
