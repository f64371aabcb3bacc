#pragma once

#include "calibration/study.h"

#include <optional>

namespace palp::fem
{

/// What a folder holds of an earlier run.
struct Saved
{
  std::vector<Indented> steps{};
  std::optional<Checkpoint> checkpoint{};
};

/// The depths of table.csv with the profiles of profiles.csv.
/// @throws Error  BadFile
[[nodiscard]] std::vector<Indented> readSteps(const std::filesystem::path& folder);

/// Lines with # that name all inputs, the energy, the mesh and the version.
[[nodiscard]] std::string describe(const Case& study, const Body& body);

/// The contents of table.csv.
[[nodiscard]] std::string tableText(
  const Case& study, const std::string& header, const Outcome& outcome);

/// The files of one calibration: table.csv, profiles.csv, fit.json and checkpoint.bin.
class StudyFiles
{
public:
  /// @throws Error  BadFile: the folder cannot be made
  StudyFiles(std::filesystem::path folder, const Case& study, const Body& body);

  /// Each file is replaced whole, so that an interruption leaves the one before.
  /// @throws Error  BadFile: not writable
  void write(const Outcome& outcome) const;
  void save(const Checkpoint& checkpoint) const;

  /// @return        nothing where there is no checkpoint
  /// @throws Error  BadFile: of another case, or damaged
  [[nodiscard]] Saved load() const;

private:
  std::filesystem::path folder_;
  const Case& study_;
  std::string header_; // lines with #, all inputs
};

} // namespace palp::fem
