#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// The table that a finished case left.
struct ResultRows
{
  std::vector<std::string> titles;
  std::vector<std::vector<std::string>> rows; ///< each as long as the titles
};

/// @param folder   of the case
/// @param kind     of the sweep
/// @param largest  a column: only the first row in which it is largest; empty: all rows
/// @throws Error   BadFile: no table, a row with other columns, no such column
[[nodiscard]] ResultRows readResult(
  const std::filesystem::path& folder, const std::string& kind, const std::string& largest);

} // namespace palp
