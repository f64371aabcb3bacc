#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace palp
{

/// Values by the names of options, as a person writes them, with their units.
using SweepValues = std::map<std::string, std::string>;

/// Names that change together, and what they take: a row for each step.
struct SweepAxis
{
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows; ///< one or more, each as long as the names
};

/// A figure of the merged table: a column over another one, a curve for each value of a third.
struct SweepPlot
{
  std::string name; ///< of the file
  std::string title;
  std::string x;                              ///< column
  std::string y;                              ///< column
  std::string curves{};                       ///< column; a curve for each of its values
  std::string colors{};                       ///< column; a map of its values in place of curves
  std::map<std::string, std::string> where{}; ///< column and value of the rows that it shows
};

/// What a SWEEP.json says, its ranges and samples written out.
///
/// Its cases are all combinations of the axes' rows; the last axis changes first.
struct Sweep
{
  std::string file{}; ///< that says so, without its folder
  std::string title;
  std::string kind; ///< calibrate, force or run: the command that a case is
  SweepValues fixed{};
  std::vector<SweepAxis> axes{};
  std::vector<SweepPlot> plots{};

  [[nodiscard]] std::size_t count() const;

  /// Of all axes, in their order.
  [[nodiscard]] std::vector<std::string> names() const;

  /// What a case gives them, in the same order.
  [[nodiscard]] std::vector<std::string> values(std::size_t number) const;

  /// @throws Error  BadFile: an axis takes the same values twice
  void refuseEqualRows() const;
};

constexpr std::size_t kMostCases = 10'000'000;

} // namespace palp
