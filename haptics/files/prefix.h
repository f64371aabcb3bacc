#pragma once

#include <cstdlib>
#include <filesystem>

namespace palp
{

/// The folder that holds this program's bin, lib and share, in a build as when installed.
///
/// The environment variable PALP_PREFIX names another one: for programs of others, which are not
/// installed beside palp-read.
/// @throws std::filesystem::filesystem_error  no /proc
[[nodiscard]] inline std::filesystem::path prefix()
{
  const char* chosen = std::getenv("PALP_PREFIX"); // NOLINT(concurrency-mt-unsafe): nobody sets it
  return chosen != nullptr && *chosen != '\0'
    ? std::filesystem::path(chosen)
    : std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
}

} // namespace palp
