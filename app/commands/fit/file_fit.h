#pragma once

#include "calibration/fit/fit_figures.h"
#include "calibration/fit/loading_rows.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace palp
{

/// What was found from one file.
struct FileFit
{
  fit::FittedCurve curve;
  fit::Rows rows; ///< that are the loading
  std::size_t rowsInFile;
  std::string note;    ///< of a recording with another tool
  std::string outside; ///< rules that the deepest row breaks
};

/// @param path  of the file, as it was named
[[nodiscard]] nlohmann::ordered_json fitJson(
  const FileFit& file, const std::filesystem::path& path);

/// One line on standard output.
void tellResult(const FileFit& file);

/// What a reader of the numbers has to know, on standard error.
///
/// @param searchesOffset  the force before the contact was searched
void tellLimits(const FileFit& file, bool searchesOffset);

} // namespace palp
