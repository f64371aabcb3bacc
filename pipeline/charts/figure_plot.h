#pragma once

#include "calibration/figures/figure.h"
#include "pipeline/charts/plot.h"

#include <memory>
#include <span>

namespace palp
{

/// Draws a figure: its band first, then its curves; a line needs two points.
///
/// @param tables  all that its curves name
/// @throws Error  BadFile: a table or column is missing
[[nodiscard]] std::unique_ptr<Plot> figurePlot(
  const figures::Figure& figure, std::span<const figures::Table> tables, figures::Layout layout);

} // namespace palp
