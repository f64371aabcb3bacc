#pragma once

#include "calibration/study/case.h"
#include "calibration/study/outcome.h"
#include "haptics/files/output_folder.h"

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace palp::fem
{

/// The names of all files that a calibration, with its pictures, may leave.
[[nodiscard]] std::vector<std::string> calibrationFiles();

/// Asked after every depth.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// Presses through all depths; where no solution is found, the depths so far remain.
/// @throws Error  BadValue: see check
[[nodiscard]] Outcome calibrate(
  const Case& study, const std::stop_token& stop = {}, const Progress& progress = {});

/// The same with files, and with every force checked by a mesh twice as coarse; a depth that fails
/// is pressed again on elements of a half to an eighth of the size. After every depth,
/// table.csv, profiles.csv, fit.json and a checkpoint are complete in the folder, whatever happens
/// next.
///
/// @param folder  stays locked; an earlier calibration in it goes when the first depth is reached
/// @param resume  go on from the folder's checkpoint, if there is one; the depths that are in the
///                table stay there, whether they are asked for again or not
/// @throws Error  BadFile: not writable, or the checkpoint is of another case, or past a depth that
///                is asked for and not in the table
[[nodiscard]] Outcome calibrateInto(OutputFolder& folder, const Case& study, bool resume,
  const std::stop_token& stop = {}, const Progress& progress = {});

} // namespace palp::fem
