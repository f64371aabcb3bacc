#pragma once

#include <filesystem>
#include <vector>

namespace palp
{

/// Rows of numbers from a file of comma-separated values; C locale.
///
/// Lines that begin with # are comments; the first other line names the columns.
///
/// @param columns  numbers in every row
/// @throws Error   BadFile: missing, or a row with other contents; names the line
[[nodiscard]] std::vector<std::vector<double>> readCsv(
  const std::filesystem::path& file, std::size_t columns);

} // namespace palp
