#include "app/program/output.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace palp
{

void addOverwrite(CLI::App& command, bool& overwrite)
{
  command.add_flag("--overwrite", overwrite, "Replace what an earlier run left in --out");
}

std::unique_ptr<OutputFolder> openOutput(
  const std::filesystem::path& folder, std::vector<std::string> own, bool overwrite)
{
  using Earlier = OutputFolder::Earlier;
  auto output = std::make_unique<OutputFolder>(
    folder, std::move(own), overwrite ? Earlier::Replace : Earlier::Refuse);
  if (!output->found().empty())
  {
    std::cerr << "palp: " << folder.string() << ": will replace " << output->found()
              << " of an earlier run\n";
  }
  return output;
}

} // namespace palp
