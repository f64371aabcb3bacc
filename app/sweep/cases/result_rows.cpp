#include "app/sweep/cases/result_rows.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

namespace palp
{
namespace
{

std::string tableName(const std::string& kind)
{
  return kind == "calibrate" ? "table.csv" : kind == "force" ? "force.csv" : "samples.csv";
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
    std::string titles;
    for (const std::string& title : table.titles)
    {
      titles += (titles.empty() ? "" : ", ") + title;
    }
    throw Error(ErrorCode::BadValue,
      "--largest: " + inQuotes(largest) + " is no column of " + file + "; there are " + titles);
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

ResultRows readResult(
  const std::filesystem::path& folder, const std::string& kind, const std::string& largest)
{
  const std::filesystem::path file = folder / tableName(kind);
  std::ifstream in(file);
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
      throw Error(ErrorCode::BadFile,
        file.string() + ": a row has " + std::to_string(cells.size()) + " cells instead of " +
          std::to_string(table.titles.size()) +
          "; remove the folder of this case and run it again");
    }
    table.rows.push_back(std::move(cells));
  }
  if (table.titles.empty())
  {
    throw Error(ErrorCode::BadFile,
      file.string() +
        ": cannot be read or is empty; remove the folder of this case and run it "
        "again");
  }
  if (!largest.empty())
  {
    keepLargest(table, largest, file.string());
  }
  return table;
}

} // namespace palp
