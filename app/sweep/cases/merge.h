#pragma once

#include "app/sweep/manifest.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// Which results are merged.
struct MergeOptions
{
  std::vector<std::filesystem::path> others{}; ///< folders of the same sweep with results, too
  std::string largest{};                       ///< see readResult
  bool partial = false;                        ///< cases without a result are left out
  bool overwrite = false;                      ///< of a table that is there
};

/// What was merged.
struct Merged
{
  std::size_t cases = 0;
  std::size_t rows = 0;
};

/// Writes the results of all cases as one table in the order of the cases: what is varied, then the
/// columns of the case's own table, `result_` before a title that one of the varied has; a column
/// that only some cases have is empty in the others. The same bytes, however the cases were
/// computed.
///
/// @param out      .csv, or .vtt for a VTK table; replaced as a whole where it may be
/// @throws Error   BadValue: another ending, a file that is there, a folder of another sweep;
/// BadFile: a result that is damaged, `out` cannot be
///                 written; NoSolution: cases without a result, unless they may be left out
Merged mergeResults(
  Manifest& manifest, const MergeOptions& options, const std::filesystem::path& out);

constexpr const char* kCaseColumn = "# case"; ///< as no other column can be named

/// The same rows of cells, the titles first, each after the number of its case.
/// @throws Error  as mergeResults
[[nodiscard]] std::vector<std::vector<std::string>> readResults(
  Manifest& manifest, const MergeOptions& options);

} // namespace palp
