#pragma once

#include "calibration/study/case.h"
#include "calibration/study/outcome.h"
#include "haptics/files/output_folder.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp::fem
{

constexpr double kSameDepth = 1e-9; ///< of a depth [-], by which the digits of a file may err

constexpr const char* kTable = "table.csv";
constexpr const char* kProfiles = "profiles.csv";

/// What a folder holds of an earlier run: the steps as readSteps gives them.
struct Saved
{
  std::vector<IndentationStep> steps{};
  std::optional<Checkpoint> checkpoint{};
  std::vector<double> refused{}; ///< depths above it that the table lacks [m]
};

/// The depths of table.csv with the profiles of profiles.csv. What no file holds is 0: base
/// reaction, penetration and inverted elements.
/// @throws Error  BadFile
[[nodiscard]] std::vector<IndentationStep> readSteps(const std::filesystem::path& folder);

/// Lines with # that name all inputs but the depths, the energy, the mesh and the version.
/// @param digits  of each number; 17 tell any two cases apart
[[nodiscard]] std::string describe(const Case& study, const Body& body, int digits = 6);

/// The contents of table.csv.
[[nodiscard]] std::string tableText(
  const Case& study, const std::string& header, const Outcome& outcome);

/// The files of one calibration: table.csv, profiles.csv, fit.json and checkpoint.bin.
class StudyFiles
{
public:
  StudyFiles(OutputFolder& folder, const Case& study, const Body& body);

  /// Each file is replaced whole, so that an interruption leaves the one before. The checkpoint
  /// comes last: it says no more than the tables.
  /// @throws Error  BadFile: not writable
  void write(const Outcome& outcome) const;
  void save(const Checkpoint& checkpoint, const std::vector<double>& refused) const;

  /// A checksum in the checkpoint covers it and the rows of both tables up to its depth.
  ///
  /// @return        up to the checkpoint; nothing where there is none
  /// @throws Error  BadFile: of another case, damaged, changed since, or already deeper than a
  ///                depth that is missing
  [[nodiscard]] Saved load() const;

private:
  OutputFolder& folder_;
  const Case& study_;
  std::string header_; // lines with #, for people
  std::string key_;    // the same with every digit, and where the nodes are
};

} // namespace palp::fem
