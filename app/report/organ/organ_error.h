#pragma once

#include "app/report/document.h"
#include "app/report/effort.h"
#include "calibration/experiments/experiments.h"

#include <functional>

namespace palp::report
{

/// Error of the force on bodies that give way as a whole, by cells of 8, 6, 4 and 3 mm, against the
/// time that an organ file of them takes; and without one.
///
/// A quick one presses one body of each kind, by cells of 8 and 6 mm.
///
/// @param tell    part of it that is done, 0 to 1, from any thread; none: who follows this thread
/// @return        what is there where it was stopped
/// @throws Error  BadFile: a table of reference or the liver is missing
[[nodiscard]] fem::Experiment organExperiment(fem::Resolution resolution,
  const std::stop_token& stop = {}, std::function<void(double)> tell = {});

/// The same as a part of the report.
/// @throws Interrupted
/// @throws Error  as organExperiment
[[nodiscard]] Section organAgainstTime(const Effort& effort);

} // namespace palp::report
