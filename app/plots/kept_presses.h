#pragma once

#include "app/plots/press_plots.h"
#include "app/press/press_log.h"
#include "pipeline/charts/force_charts.h"

#include <span>
#include <vector>

namespace palp
{

/// How the curve of a press is drawn, wherever it is.
struct PressPen
{
  appearance::Color color;
  appearance::LineStyle style; ///< the next one after as many presses as there are colors
};

/// By its number, so that a press keeps its color.
[[nodiscard]] PressPen penOf(const KeptPress& press) noexcept;

/// The same presses for a chart that is live.
[[nodiscard]] std::vector<PressCurve> pressCurves(std::span<const KeptPress* const> presses);

/// F(depth) of presses, from touch to release; nothing of none.
[[nodiscard]] Plots pressForces(std::span<const KeptPress* const> presses);

/// How far the force of the others is from that of the first, on the way in.
[[nodiscard]] Plots pressDifferences(std::span<const KeptPress* const> presses);

} // namespace palp
