#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// Writes a table row by row, with as much memory for a million rows as for one.
class TableWriter
{
public:
  virtual ~TableWriter() = default;

  /// @param cells  as many as there are columns; empty: none there
  /// @return       false: a cell of a column of numbers is a word; the table is spoiled
  virtual bool add(const std::vector<std::string>& cells) = 0;

  /// @throws Error  BadFile: the disk is full, or another failure of any write before
  virtual void finish() = 0;
};

/// A column of a table that is written.
struct WrittenColumn
{
  std::string title;
  bool isNumber; ///< else words
};

/// The number in a cell, NaN where it is empty.
/// @return  nothing where it is a word
[[nodiscard]] std::optional<double> numberOf(const std::string& cell);

/// Comma-separated values as RFC 4180 has them.
[[nodiscard]] std::unique_ptr<TableWriter> makeCsvWriter(
  const std::filesystem::path& file, const std::vector<WrittenColumn>& columns);

/// A VTK table (.vtt): numbers as Float64, NaN where there is none, and words as String, appended
/// without encoding. Columns wait in files beside it.
[[nodiscard]] std::unique_ptr<TableWriter> makeVtkWriter(
  const std::filesystem::path& file, const std::vector<WrittenColumn>& columns);

} // namespace palp
