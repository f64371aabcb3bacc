#pragma once

#include <string>
#include <variant>
#include <vector>

namespace palp::figures
{

/// A number, or a word. A number that is not there is not a number.
using Cell = std::variant<double, std::string>;

/// Measured or computed numbers, written as NAME.csv; every figure is drawn from such tables.
struct Table
{
  std::string name;
  std::string caption;
  std::vector<std::string> columns; ///< each name ends in its unit
  std::vector<std::vector<Cell>> rows{};
  bool shown = true; ///< on a page; else linked only

  /// @throws Error  BadFile: no such column
  [[nodiscard]] std::size_t indexOf(const std::string& column) const;

  /// A column of numbers.
  /// @throws Error  BadFile: no such column, or it has words
  [[nodiscard]] std::vector<double> column(const std::string& title) const;
};

/// A cell as a file has it: the shortest digits, or fewer; empty where there is no number.
/// @param digits  that count; 0: those that read back as the same number
[[nodiscard]] std::string textOf(const Cell& cell, int digits = 0);

/// A cell for people: a number with four significant digits.
[[nodiscard]] std::string shown(const Cell& cell);

/// Comma-separated values as RFC 4180 has them, the columns first.
/// @param digits  as textOf
[[nodiscard]] std::string csv(const Table& table, int digits = 0);

} // namespace palp::figures
