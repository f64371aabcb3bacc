#pragma once

#include "calibration/tables/organ_table.h"

#include <filesystem>

namespace palp
{

/// Replaces an organ file, with the SHA-256 of all its other lines in the second.
/// @throws Error  BadFile: cannot be written
void writeSealed(const std::filesystem::path& file, const OrganTable& table);

/// Whether an organ file is as it was written; one without the line is taken as it is, so that
/// other programs and hands may write such files.
/// @throws Error  BadFile: it is not, or cannot be read
void checkSeal(const std::filesystem::path& file);

} // namespace palp
