#pragma once

#include "app/sweep/case_inputs.h"
#include "app/sweep/sweep.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace palp
{

/// Tells whether a command takes such words, without running it.
/// @throws Error  BadValue: in one sentence what it refuses
using CheckCase = std::function<void(const std::vector<std::string>& words)>;

/// What a plan says of the folder that it is made in.
struct PlanTold
{
  std::size_t count = 0;
  std::size_t done = 0; ///< of them that the folder holds results of
};

/// Writes the plan of a sweep into a folder, which is made when it is missing. What it holds of
/// an earlier plan stays: a case that is the same in both is not computed again.
///
/// Every value of every axis is checked in a case, but of samples at most a thousand; what only
/// some combinations break is told when those are run.
///
/// @param sweep    see readSweepFile
/// @param beside   folder that its files are relative to, an absolute path
/// @param options  of the command that its cases are
/// @throws Error   BadFile: a name that is no option and stands in no value, a file that cannot be
///                 read or written; BadValue: a case that the command refuses, by its number
PlanTold planSweep(const Sweep& sweep, const std::filesystem::path& beside,
  const CommandOptions& options, const CheckCase& check, const std::filesystem::path& folder);

} // namespace palp
