#pragma once

#include "app/program/interrupt.h"
#include "haptics/files/output_folder.h"

#include <memory>
#include <mutex>
#include <vector>

namespace CLI
{
class App;
}

namespace palp
{

/// Adds --overwrite to a command that writes files.
void addOverwrite(CLI::App& command, bool& overwrite);

/// Refuses to replace what a command reads.
///
/// @param own     names of all files that it may leave in the folder
/// @param inputs  files that it reads; an empty one is none
/// @throws Error  BadValue: one of them is one of those, by whatever name or link
void keepInputs(const std::filesystem::path& folder, const std::vector<std::string>& own,
  const std::vector<std::filesystem::path>& inputs);

/// Opens the folder that a command writes, before any work.
///
/// @param own        names of all files that such a run may leave
/// @param overwrite  says on standard error which files will be replaced; else they are refused
/// @param inputs     as keepInputs
/// @throws Error     as OutputFolder, keepInputs
[[nodiscard]] std::unique_ptr<OutputFolder> openOutput(const std::filesystem::path& folder,
  std::vector<std::string> own, bool overwrite,
  const std::vector<std::filesystem::path>& inputs = {});

/// Files that the run may leave besides, whose names are known only by now; says which of them will
/// be replaced.
/// @throws Error  as OutputFolder::expect
void expectOutput(const OutputFolder& output, const std::vector<std::string>& names);

/// The folders that a command writes; while it lives, Ctrl-C, SIGTERM and a terminal that closes
/// end the program, but leave nothing there that is not published.
///
/// Made as Interrupt is, which none is beside it.
class Outputs
{
public:
  Outputs();
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// As openOutput; the folder lives as long as this.
  [[nodiscard]] OutputFolder& open(const std::filesystem::path& folder,
    std::vector<std::string> own, bool overwrite,
    const std::vector<std::filesystem::path>& inputs = {});

private:
  std::mutex mutex_; // over the folders: none is half made when a signal ends the program
  std::vector<std::unique_ptr<OutputFolder>> folders_;
  Interrupt interrupt_;
};

} // namespace palp
