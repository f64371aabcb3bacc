#pragma once

#include "app/sweep/cases/merge.h"
#include "calibration/figures/figure.h"

#include <string>
#include <vector>

namespace palp
{

/// What a sweep's plots show.
struct SweepFigures
{
  std::vector<figures::Table> tables{}; ///< one for each figure
  std::vector<figures::Figure> figures{};
  std::vector<std::string> refused{}; ///< a sentence for each plot that could not be drawn
};

/// The plots that a sweep names, from its results.
/// @throws Error  as mergeResults
[[nodiscard]] SweepFigures sweepFigures(Manifest& manifest, const MergeOptions& options);

} // namespace palp
