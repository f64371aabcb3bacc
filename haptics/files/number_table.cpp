#include "haptics/files/number_table.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/input_text.h"

#include <algorithm>
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

constexpr const char* kWhat = "a CSV file";

std::vector<std::string> columnsIn(const std::string& line)
{
  std::vector<std::string> names = csvFields(line);
  for (std::string& name : names)
  {
    name = trimmed(name);
  }
  return names;
}

double numberIn(std::string_view cell, const std::string& header)
{
  const std::optional<double> value = csvNumber(cell);
  if (!value)
  {
    throw Error(ErrorCode::BadFile, inQuotes(cell) + " is not a number; give " + shortened(header));
  }
  return *value;
}

struct Header
{
  std::string line;
  std::vector<std::string> names;
};

// which columns of a table are read; throws what is wrong without saying where
using ChooseColumns = std::function<std::vector<std::size_t>(const Header& header)>;

// the chosen numbers of one line; throws what is wrong without saying where
std::vector<double> parseLine(
  const std::string& line, const std::vector<std::size_t>& chosen, const Header& header)
{
  const std::vector<std::string> cells = csvFields(line);
  if (cells.size() != header.names.size())
  {
    throw Error(ErrorCode::BadFile,
      std::to_string(cells.size()) + " columns; give " + shortened(header.line));
  }
  std::vector<double> values;
  values.reserve(chosen.size());
  for (const std::size_t column : chosen)
  {
    values.push_back(numberIn(trimmed(cells[column]), header.line));
  }
  return values;
}

NumberTable rowsIn(std::string text, const std::filesystem::path& file, const ChooseColumns& choose)
{
  std::istringstream stream(std::move(text));
  NumberTable table;
  Header header;
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
      header.names.empty() ? table.comments.push_back(line) : void();
      continue;
    }
    try
    {
      if (header.names.empty())
      {
        header = { .line = line, .names = columnsIn(line) };
        chosen = choose(header);
        continue;
      }
      table.rows.push_back({ parseLine(line, chosen, header), number });
    }
    catch (const Error& error)
    {
      throw Error(ErrorCode::BadFile, where(file, number) + error.what());
    }
  }
  return table;
}

NumberTable readRows(const std::filesystem::path& file, const ChooseColumns& choose)
{
  return rowsIn(readText(file, kWhat), file, choose);
}

ChooseColumns allUnder(const std::string& header)
{
  return [header](const Header& found)
  {
    if (found.line != header)
    {
      throw Error(
        ErrorCode::BadFile, inQuotes(found.line) + " is not the header; begin with " + header);
    }
    std::vector<std::size_t> all(found.names.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  };
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

// @param wanted  the columns to read, by the names of all
template <typename Wanted>
NumberTable readNamed(const std::filesystem::path& file, Wanted wanted)
{
  std::vector<std::string> names;
  const auto indicesOf = [&](const Header& header)
  {
    names = header.names;
    std::vector<std::size_t> chosen;
    for (const char* column : wanted(names))
    {
      const auto found = std::ranges::find(names, column);
      if (found == names.end())
      {
        throw Error(ErrorCode::BadFile,
          "no column " + std::string(column) + " in " + inQuotes(header.line) +
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
  };
  NumberTable table = readRows(file, indicesOf);
  if (names.empty())
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": no column " + wanted(names).front() + "; begin with a line that names it");
  }
  table.names = std::move(names);
  refuseInfinite(table, file);
  return table;
}

} // namespace

std::string where(const std::filesystem::path& file, int line)
{
  return file.string() + ":" + std::to_string(line) + ": ";
}

NumberTable NumberTable::read(const std::filesystem::path& file, const std::string& header)
{
  return readRows(file, allUnder(header));
}

NumberTable NumberTable::readFinite(const std::filesystem::path& file, const std::string& header)
{
  return finiteIn(readText(file, kWhat), file, header);
}

NumberTable NumberTable::finiteIn(
  std::string text, const std::filesystem::path& file, const std::string& header)
{
  NumberTable table = rowsIn(std::move(text), file, allUnder(header));
  refuseInfinite(table, file);
  return table;
}

NumberTable NumberTable::readColumns(
  const std::filesystem::path& file, std::span<const char* const> columns)
{
  return readNamed(file,
    [columns](const auto&) { return std::vector<const char*>(columns.begin(), columns.end()); });
}

NumberTable NumberTable::readRecording(
  const std::filesystem::path& file, std::span<const char* const> columns)
{
  constexpr const char* kHand = "hand";
  bool isOfHands = false;
  NumberTable table = readNamed(file,
    [&](const std::vector<std::string>& ofFile)
    {
      const auto has = [&ofFile](const char* name)
      { return std::ranges::find(ofFile, name) != ofFile.end(); };
      isOfHands = has(kHand) && has("tool_x_mm");
      std::vector<const char*> wanted(columns.begin(), columns.end());
      if (isOfHands)
      {
        wanted.push_back(kHand);
      }
      return wanted;
    });
  if (isOfHands)
  {
    std::erase_if(table.rows, [](const Row& row) { return row.values.back() != 1.0; });
    std::ranges::for_each(table.rows, [](Row& row) { row.values.pop_back(); });
  }
  return table;
}

} // namespace palp
