#include "haptics/files/number_table.h"

#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

// the numbers of one line; throws what is wrong without saying where
std::vector<double> parseLine(std::string_view line, const std::string& header)
{
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view cell = line.substr(begin, end - begin);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || stop != cell.data() + cell.size())
    {
      throw Error(
        ErrorCode::BadFile, inQuotes(cell) + " is not a number; give " + shortened(header));
    }
    values.push_back(value);
    begin = end + 1;
  }
  if (std::count(header.begin(), header.end(), ',') + 1 != std::ssize(values))
  {
    throw Error(
      ErrorCode::BadFile, std::to_string(values.size()) + " columns; give " + shortened(header));
  }
  return values;
}

// what a table's first line says; throws what is wrong without saying where
using CheckHeader = std::function<void(const std::string& line)>;

NumberTable readRows(const std::filesystem::path& file, const CheckHeader& check)
{
  std::istringstream stream(readText(file, "a CSV file"));
  NumberTable table;
  std::string header;
  int number = 0;
  for (std::string line; std::getline(stream, line);)
  {
    table.lastLine = ++number;
    if (line.ends_with('\r'))
    {
      line.pop_back();
    }
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    try
    {
      if (header.empty())
      {
        check(line);
        header = line;
        continue;
      }
      table.rows.push_back({ parseLine(line, header), number });
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

std::vector<std::string> namesIn(const std::string& header)
{
  std::vector<std::string> names;
  std::istringstream text(header);
  for (std::string name; std::getline(text, name, ',');)
  {
    names.push_back(name);
  }
  return names;
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
  std::vector<std::size_t> positions;
  std::vector<std::string> names;
  const auto findColumns = [&](const std::string& line)
  {
    names = namesIn(line);
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
      positions.push_back(static_cast<std::size_t>(found - names.begin()));
    }
  };
  NumberTable table = readRows(file, findColumns);
  if (positions.empty())
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": no column " + columns.front() + "; begin with a line that names it");
  }
  table.names = std::move(names);
  for (Row& row : table.rows)
  {
    std::vector<double> picked;
    picked.reserve(positions.size());
    for (const std::size_t position : positions)
    {
      picked.push_back(row.values[position]);
    }
    row.values = std::move(picked);
  }
  refuseInfinite(table, file); // what nobody asked for may be: a half-space is infinitely thick
  return table;
}

} // namespace palp
