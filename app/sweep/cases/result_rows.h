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

/// The file of a case's folder that holds its table.
/// @param kind  of the sweep
[[nodiscard]] std::filesystem::path resultTable(
  const std::filesystem::path& folder, const std::string& kind);

/// Whether the folder of a case holds what that case left there.
[[nodiscard]] bool isIntact(const std::filesystem::path& folder, const std::string& kind);

/// @param folder   of the case, which has its name
/// @param kind     of the sweep
/// @param largest  a column: only the first row in which it is largest; empty: all rows
/// @throws Error   BadFile: no table, or one that is not what its case left; BadValue: no such
///                 column
[[nodiscard]] ResultRows readResult(
  const std::filesystem::path& folder, const std::string& kind, const std::string& largest);

} // namespace palp
