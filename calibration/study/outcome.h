#pragma once

#include "calibration/fem/indenter.h"

#include <string>
#include <vector>

namespace palp::fem
{

/// How a calibration went.
struct Outcome
{
  std::vector<IndentationStep> steps; ///< one for each depth that was reached and not refused
  std::string error;                  ///< empty, or why depths are missing
  std::vector<double> refused{};      ///< depths whose force depends on the mesh [m]
};

/// R_d at the deformed position [m]: where the surface is lowered by the threshold; 0 where
/// nothing sinks that far, the outermost radius where everything does.
/// @source  Sec. 3.3.2
[[nodiscard]] double extentRadius(
  const std::vector<IndentationStep::Point>& profile, double threshold);

/// Depth of the surface below rest at a deformed radius, straight between points [m].
[[nodiscard]] double sinkOf(const IndentationStep& pressed, double radius);

} // namespace palp::fem
