#pragma once

#include "app/sweep/cases/merge.h"
#include "calibration/figures/figure.h"

#include <vector>

namespace palp
{

/// What a sweep's plots show.
struct SweepFigures
{
  std::vector<figures::Table> tables{}; ///< one for each figure
  std::vector<figures::Figure> figures{};
};

/// The plots that a sweep names, from its results.
/// @throws Error  BadFile: a column that is not there; as mergeResults
[[nodiscard]] SweepFigures sweepFigures(Manifest& manifest, const MergeOptions& options);

} // namespace palp
