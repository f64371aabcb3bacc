#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// Refuses what contradicts an export folder, whose scene says all.
/// @param allowed  names of the options that may stand beside it
/// @throws Error   BadValue: names the first other one that was given
void refuseBeside(const CLI::App& command, const std::filesystem::path& folder,
  const std::vector<std::string>& allowed);

} // namespace palp
