#include "app/sweep/cases/result_rows.h"

#include "app/program/sha256.h"
#include "app/sweep/cases/case_record.h"
#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"
#include "haptics/files/listed.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace palp
{
namespace
{

[[noreturn]] void refuseDamaged(const std::filesystem::path& file)
{
  throw Error(ErrorCode::BadFile,
    file.string() +
      ": is not what its case left, or gone; palp sweep run DIR --check computes it again");
}

// all of it, as the record of the case has it
std::optional<std::string> wholeText(
  const std::filesystem::path& folder, const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::string text{ std::istreambuf_iterator<char>(in), {} };
  const auto record = readRecord(folder);
  const bool isWhole = in && record && record->name == folder.filename() &&
    record->failed.empty() && record->tableSha256 == sha256Of(text);
  return isWhole ? std::optional(std::move(text)) : std::nullopt;
}

double valueOf(const std::string& cell)
{
  double value = -std::numeric_limits<double>::infinity();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

void keepLargest(ResultRows& table, const std::string& largest, const std::string& file)
{
  const auto column = std::ranges::find(table.titles, largest);
  if (column == table.titles.end())
  {
    throw Error(ErrorCode::BadValue,
      "--largest: " + inQuotes(largest) + " is no column of " + file + "; there are " +
        listed(table.titles));
  }
  const auto at = static_cast<std::size_t>(column - table.titles.begin());
  const auto best =
    std::ranges::max_element(table.rows, {}, [&](const auto& row) { return valueOf(row[at]); });
  if (best != table.rows.end())
  {
    table.rows = { std::vector<std::string>(*best) };
  }
}

} // namespace

std::filesystem::path resultTable(const std::filesystem::path& folder, const std::string& kind)
{
  return folder /
    (kind == "calibrate"  ? "table.csv"
        : kind == "force" ? "force.csv"
                          : "samples.csv");
}

bool isIntact(const std::filesystem::path& folder, const std::string& kind)
{
  return wholeText(folder, resultTable(folder, kind)).has_value();
}

ResultRows readResult(
  const std::filesystem::path& folder, const std::string& kind, const std::string& largest)
{
  const std::filesystem::path file = resultTable(folder, kind);
  const std::optional<std::string> text = wholeText(folder, file);
  if (!text)
  {
    refuseDamaged(file);
  }
  std::istringstream in(*text);
  ResultRows table;
  for (std::string line; std::getline(in, line);)
  {
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    std::vector<std::string> cells = csvFields(line);
    if (table.titles.empty())
    {
      table.titles = std::move(cells);
      continue;
    }
    if (cells.size() != table.titles.size())
    {
      refuseDamaged(file);
    }
    table.rows.push_back(std::move(cells));
  }
  if (table.titles.empty())
  {
    refuseDamaged(file);
  }
  if (!largest.empty())
  {
    keepLargest(table, largest, file.string());
  }
  return table;
}

} // namespace palp
