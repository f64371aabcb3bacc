#pragma once

#include "pipeline/process/child_process.h"

#include <filesystem>
#include <vector>

namespace palp
{

/// What reading a file may take: several times what the slowest reader takes for an honest file of
/// its size, or of the size that an image's header claims; never more memory than there is.
[[nodiscard]] ChildLimits readLimits(const std::filesystem::path& file);

/// @throws Error  BadFile: an image that claims more memory than this machine has
void checkFits(const std::filesystem::path& file);

/// What has to be opened to read a file: itself; for an MHD, its folder.
[[nodiscard]] std::vector<std::filesystem::path> neededFiles(const std::filesystem::path& file);

} // namespace palp
