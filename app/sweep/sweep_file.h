#pragma once

#include "app/sweep/sweep.h"

#include <filesystem>
#include <string>

namespace palp
{

/// Reads a sweep: one JSON object, version 1, described by data/sweeps/sweep.schema.json.
///
/// @param name    of a file, or of a shipped sweep
/// @throws Error  BadFile: not there (names the shipped ones), not JSON, another version, an
///                unknown key, a name that stands twice, a range that is none, too many cases
[[nodiscard]] Sweep readSweepFile(const std::string& name);

/// The file that such a name stands for.
/// @throws Error  BadFile: not there
[[nodiscard]] std::filesystem::path sweepFile(const std::string& name);

} // namespace palp
