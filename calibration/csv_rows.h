#pragma once

#include <filesystem>
#include <vector>

namespace palp
{

/// Rows of finite numbers from a file whose columns are known by their order only; where their
/// names are known, NumberTable compares them.
///
/// Lines that begin with # are comments; the first other line names the columns.
///
/// @param columns  numbers in every row
/// @throws Error   BadFile: missing, no names of as many columns, or a row with other contents;
///                 names the line
[[nodiscard]] std::vector<std::vector<double>> readCsv(
  const std::filesystem::path& file, std::size_t columns);

} // namespace palp
