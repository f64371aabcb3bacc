#pragma once

#include "app/press_options.h"
#include "calibration/extent_table.h"
#include "pipeline/fitted_surfaces.h"

#include <optional>

namespace palp
{

/// How the surface gives way around a tool, as found by finite elements.
struct Calibration
{
  ExtentTable extents;                    ///< R_d(depth), for the paper's ring
  std::optional<FittedSurfaces> surfaces; ///< to follow instead of that ring; none: the paper's
};

/// The tables that the options name, or the bundled ones nearest to the tool.
/// @throws Error  BadFile
[[nodiscard]] Calibration loadCalibration(const PressOptions& options, const Tip& tip);

} // namespace palp
