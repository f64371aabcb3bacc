#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace palp
{

/// Numbers of a comma-separated file with a known header; lines that begin with # are comments.
struct NumberTable
{
  struct Row
  {
    std::vector<double> values; ///< of the columns that were asked for
    int line;                   ///< in the file, from 1
  };

  std::vector<Row> rows;
  std::vector<std::string> comments; ///< lines above the header, with their #
  std::vector<std::string> names;    ///< of all the file's columns; not by read()
  int lastLine = 1;

  /// @throws Error  BadFile: missing, another header, not a number, too few columns; with the line
  [[nodiscard]] static NumberTable read(
    const std::filesystem::path& file, const std::string& header);

  /// @throws Error  BadFile: also where a number is infinite or none
  [[nodiscard]] static NumberTable readFinite(
    const std::filesystem::path& file, const std::string& header);

  /// As readFinite, of what a file holds.
  [[nodiscard]] static NumberTable finiteIn(
    std::string text, const std::filesystem::path& file, const std::string& header);

  /// Columns by their names, in the order asked for, wherever they stand among others, which may
  /// hold words.
  /// @throws Error  BadFile: as readFinite; a column that is missing
  [[nodiscard]] static NumberTable readColumns(
    const std::filesystem::path& file, std::span<const char* const> columns);

  /// As readColumns; of an exported recording of two hands the rows of hand 1.
  [[nodiscard]] static NumberTable readRecording(
    const std::filesystem::path& file, std::span<const char* const> columns);
};

/// "FILE:LINE: ", as messages begin.
[[nodiscard]] std::string where(const std::filesystem::path& file, int line);

} // namespace palp
