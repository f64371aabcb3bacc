#include "haptics/files/number_table.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

std::string_view withoutBlanks(std::string_view text)
{
  constexpr const char* kBlanks = " \t";
  const std::size_t first = std::min(text.find_first_not_of(kBlanks), text.size());
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

// of one line, without what stands around them; a comma in quotes ends none
std::vector<std::string_view> cellsOf(std::string_view line)
{
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i)
  {
    quoted = quoted != (i < line.size() && line[i] == '"');
    if (i == line.size() || (line[i] == ',' && !quoted))
    {
      std::string_view cell = withoutBlanks(line.substr(begin, i - begin));
      if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      {
        cell = withoutBlanks(cell.substr(1, cell.size() - 2));
      }
      cells.push_back(cell);
      begin = i + 1;
    }
  }
  return cells;
}

double numberIn(std::string_view cell, const std::string& header)
{
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || stop != cell.data() + cell.size())
  {
    throw Error(ErrorCode::BadFile, inQuotes(cell) + " is not a number; give " + shortened(header));
  }
  return value;
}

// which columns of a table are read, by its first line; throws what is wrong without saying where
using ChooseColumns = std::function<std::vector<std::size_t>(const std::string& line)>;

// the chosen numbers of one line; throws what is wrong without saying where
std::vector<double> parseLine(std::string_view line, std::size_t columns,
  const std::vector<std::size_t>& chosen, const std::string& header)
{
  const std::vector<std::string_view> cells = cellsOf(line);
  if (cells.size() != columns)
  {
    throw Error(
      ErrorCode::BadFile, std::to_string(cells.size()) + " columns; give " + shortened(header));
  }
  std::vector<double> values;
  values.reserve(chosen.size());
  for (const std::size_t column : chosen)
  {
    values.push_back(numberIn(cells[column], header));
  }
  return values;
}

NumberTable readRows(const std::filesystem::path& file, const ChooseColumns& choose)
{
  std::istringstream stream(readText(file, "a CSV file"));
  NumberTable table;
  std::string header;
  std::size_t columns = 0;
  std::vector<std::size_t> chosen;
  int number = 0;
  for (std::string line; std::getline(stream, line);)
  {
    table.lastLine = ++number;
    if (line.ends_with('\r'))
    {
      line.pop_back();
    }
    if (line.empty())
    {
      continue;
    }
    if (line.front() == '#')
    {
      header.empty() ? table.comments.push_back(line) : void();
      continue;
    }
    try
    {
      if (header.empty())
      {
        chosen = choose(line);
        header = line;
        columns = cellsOf(line).size();
        continue;
      }
      table.rows.push_back({ parseLine(line, columns, chosen, header), number });
    }
    catch (const Error& error)
    {
      throw Error(ErrorCode::BadFile, where(file, number) + error.what());
    }
  }
  return table;
}

void refuseInfinite(const NumberTable& table, const std::filesystem::path& file)
{
  for (const auto& [values, line] : table.rows)
  {
    if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
    {
      throw Error(ErrorCode::BadFile, where(file, line) + "not finite; give numbers");
    }
  }
}

} // namespace

std::string where(const std::filesystem::path& file, int line)
{
  return file.string() + ":" + std::to_string(line) + ": ";
}

NumberTable NumberTable::read(const std::filesystem::path& file, const std::string& header)
{
  return readRows(file,
    [&header](const std::string& line)
    {
      if (line != header)
      {
        throw Error(
          ErrorCode::BadFile, inQuotes(line) + " is not the header; begin with " + header);
      }
      std::vector<std::size_t> all(cellsOf(header).size());
      std::iota(all.begin(), all.end(), 0);
      return all;
    });
}

NumberTable NumberTable::readFinite(const std::filesystem::path& file, const std::string& header)
{
  NumberTable table = read(file, header);
  refuseInfinite(table, file);
  return table;
}

NumberTable NumberTable::readColumns(
  const std::filesystem::path& file, std::span<const char* const> columns)
{
  std::vector<std::string> names;
  NumberTable table = readRows(file,
    [&](const std::string& line)
    {
      const std::vector<std::string_view> cells = cellsOf(line);
      names.assign(cells.begin(), cells.end());
      std::vector<std::size_t> chosen;
      for (const char* column : columns)
      {
        const auto found = std::ranges::find(names, column);
        if (found == names.end())
        {
          throw Error(ErrorCode::BadFile,
            "no column " + std::string(column) + " in " + inQuotes(line) +
              "; begin with a line that names it, with commas between");
        }
        if (std::ranges::count(names, column) > 1)
        {
          throw Error(
            ErrorCode::BadFile, "two columns " + std::string(column) + "; leave one of them out");
        }
        chosen.push_back(static_cast<std::size_t>(found - names.begin()));
      }
      return chosen;
    });
  if (names.empty())
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": no column " + columns.front() + "; begin with a line that names it");
  }
  table.names = std::move(names);
  refuseInfinite(table, file);
  return table;
}

} // namespace palp
