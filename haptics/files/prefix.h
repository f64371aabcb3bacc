#pragma once

#include <filesystem>

namespace palp
{

/// The folder that holds this program's bin, lib and share, in a build as when installed.
/// @throws std::filesystem::filesystem_error  no /proc
[[nodiscard]] inline std::filesystem::path prefix()
{
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

} // namespace palp
