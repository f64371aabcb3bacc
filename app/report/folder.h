#pragma once

#include "app/report/document.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace palp::report
{

/// The folder of a report: machine.json, and for every finished part NAME.json and its CSV files.
class Folder
{
public:
  /// @param machine  what describeMachine() says
  /// @param resume   go on with what the folder holds
  /// @throws Error   BadFile: not writable, holds a report already, or one of other settings
  Folder(
    std::filesystem::path path, bool quick, const nlohmann::ordered_json& machine, bool resume);

  /// @return        nothing where the part is not finished
  /// @throws Error  BadFile: damaged
  [[nodiscard]] std::optional<Section> finished(const std::string& part) const;

  /// @throws Error  BadFile: not writable
  void keep(const Section& section) const;

  [[nodiscard]] const std::filesystem::path& path() const noexcept
  {
    return path_;
  }

  /// The machine, and what was asked for; of the first run.
  [[nodiscard]] const nlohmann::ordered_json& machine() const noexcept
  {
    return machine_;
  }

private:
  std::filesystem::path path_;
  nlohmann::ordered_json machine_;
};

} // namespace palp::report
