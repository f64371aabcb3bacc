#include "haptics/force/number_table.h"

#include "haptics/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

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
        ErrorCode::BadFile, "'" + std::string(cell) + "' is not a number; give " + header);
    }
    values.push_back(value);
    begin = end + 1;
  }
  if (std::count(header.begin(), header.end(), ',') + 1 != std::ssize(values))
  {
    throw Error(ErrorCode::BadFile, std::to_string(values.size()) + " columns; give " + header);
  }
  return values;
}

} // namespace

std::string where(const std::filesystem::path& file, int line)
{
  return file.string() + ":" + std::to_string(line) + ": ";
}

NumberTable NumberTable::read(const std::filesystem::path& file, const std::string& header)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be read; check the path");
  }
  NumberTable table;
  bool started = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);)
  {
    table.lastLine = ++number;
    if (!line.empty() && line.back() == '\r')
    {
      line.pop_back();
    }
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    if (!started && line != header)
    {
      throw Error(ErrorCode::BadFile, where(file, number) + "no header; begin with " + header);
    }
    if (started)
    {
      try
      {
        table.rows.push_back({ parseLine(line, header), number });
      }
      catch (const Error& error)
      {
        throw Error(ErrorCode::BadFile, where(file, number) + error.what());
      }
    }
    started = true;
  }
  return table;
}

NumberTable NumberTable::readFinite(const std::filesystem::path& file, const std::string& header)
{
  NumberTable table = read(file, header);
  for (const Row& row : table.rows)
  {
    if (!std::ranges::all_of(row.values, [](double value) { return std::isfinite(value); }))
    {
      throw Error(ErrorCode::BadFile, where(file, row.line) + "not finite; give numbers");
    }
  }
  return table;
}

} // namespace palp
