#pragma once

#include "app/sweep/case_inputs.h"
#include "app/sweep/sweep.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace palp
{

/// What a sweep varies, as a column of the merged table.
struct SweepColumn
{
  std::string name;
  std::string unit{};    ///< of all its values, taken off them
  bool isNumber = false; ///< each value is a number and that unit

  /// The name with the unit, as `young_kPa`.
  [[nodiscard]] std::string title() const;

  /// A value as the merged table has it, without its unit.
  [[nodiscard]] std::string cell(const std::string& value) const;
};

/// One case of a planned sweep.
struct PlannedCase
{
  std::size_t number;              ///< from 0
  std::string name;                ///< see caseName
  std::vector<std::string> values; ///< of the columns, as they were written
};

/// What all cases of a planned sweep share.
struct SweepHead
{
  std::string title;
  std::string kind;
  std::size_t count = 0;
  std::vector<SweepColumn> columns{};
  std::filesystem::path beside{}; ///< folder that files are relative to, absolute
  SweepValues fixed{};
  std::set<std::string> options{};            ///< those names that are options
  std::set<std::string> flags{};              ///< those that are flags
  std::map<std::string, std::string> files{}; ///< SHA-256 by absolute path
  std::vector<SweepPlot> plots{};
};

/// The options of a case, filled in, its files by absolute path.
/// @throws Error  BadValue: see filledIn
[[nodiscard]] SweepValues optionsOf(const SweepHead& head, const std::vector<std::string>& values);

/// The plan in a sweep's folder: cases.csv, one line for each case after the lines that say what
/// all of them share.
///
/// It is opened once and stays what it was, whatever is planned there meanwhile.
class Manifest
{
public:
  /// @throws Error  BadFile: none there, damaged, or of another version of palp
  explicit Manifest(std::filesystem::path folder);

  /// Whether a file is a plan, of whatever version.
  [[nodiscard]] static bool isOne(const std::filesystem::path& file);

  /// Writes the plan as a whole.
  /// @param caseAt  for 0 to head.count - 1, in this order
  static void write(const std::filesystem::path& folder, const SweepHead& head,
    const std::function<PlannedCase(std::size_t)>& caseAt);

  [[nodiscard]] const std::filesystem::path& folder() const noexcept
  {
    return folder_;
  }
  [[nodiscard]] const SweepHead& head() const noexcept
  {
    return head_;
  }

  /// A case by its number, found by bisection.
  /// @throws Error  BadValue: no such case; BadFile: its line is damaged
  [[nodiscard]] PlannedCase at(std::size_t number);

  /// The numbers of cases in a row, at most those that there are.
  [[nodiscard]] std::vector<std::size_t> numbers(
    std::size_t begin = 0, std::size_t count = kMostCases) const;

  /// All of them in their order.
  void forEach(const std::function<void(const PlannedCase&)>& take);

  /// Whether the plan still says what the case was planned as.
  /// @param options  of the case
  /// @throws Error   BadFile: it was edited
  void refuseEdited(const PlannedCase& one, const SweepValues& options) const;

private:
  [[nodiscard]] PlannedCase parse(const std::string& line) const;

  std::filesystem::path folder_;
  SweepHead head_;
  std::ifstream file_;
  std::streamoff begin_ = 0; // of the first case
  std::streamoff end_ = 0;
};

} // namespace palp
