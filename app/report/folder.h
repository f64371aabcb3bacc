#pragma once

#include "app/report/document.h"
#include "haptics/files/output_folder.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace palp::report
{

/// What becomes of a report that is there already.
enum class Before
{
  Refuse,
  Replace, ///< when the first new part is kept
  Resume,
};

/// The folder of a report: machine.json, and for every finished part NAME.json and its CSV files.
class Folder
{
public:
  /// @param machine  what describeMachine() says
  /// @throws Error   BadFile: not writable, in use, holds a report already, or one of other
  /// settings
  Folder(const std::filesystem::path& path, bool quick, const nlohmann::ordered_json& machine,
    Before before);

  /// @return        nothing where the part is not finished
  /// @throws Error  BadFile: damaged
  [[nodiscard]] std::optional<Section> finished(const std::string& part) const;

  /// @throws Error  BadFile: not writable
  void keep(const Section& section);

  /// Locked; its stage is for more files.
  [[nodiscard]] OutputFolder& output() noexcept
  {
    return output_;
  }

  /// The machine, and what was asked for; of the first run.
  [[nodiscard]] const nlohmann::ordered_json& machine() const noexcept
  {
    return machine_;
  }

private:
  Before before_;
  OutputFolder output_;
  nlohmann::ordered_json machine_;
};

} // namespace palp::report
