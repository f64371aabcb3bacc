#pragma once

#include "haptics/files/output_folder.h"

#include <memory>

namespace CLI
{
class App;
}

namespace palp
{

/// Adds --overwrite to a command that writes files.
void addOverwrite(CLI::App& command, bool& overwrite);

/// Opens the folder that a command writes, before any work.
///
/// @param own        names of all files that such a run may leave
/// @param overwrite  says on standard error which files will be replaced; else they are refused
/// @param inputs     files that the run reads
/// @throws Error     as OutputFolder; BadValue: an input would be replaced
[[nodiscard]] std::unique_ptr<OutputFolder> openOutput(const std::filesystem::path& folder,
  std::vector<std::string> own, bool overwrite,
  const std::vector<std::filesystem::path>& inputs = {});

} // namespace palp
