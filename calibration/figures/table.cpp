#include "calibration/figures/table.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace palp::figures
{
namespace
{

std::string formatted(double value, std::chars_format format, int digits)
{
  char text[64];
  return { text, std::to_chars(text, text + sizeof text, value, format, digits).ptr };
}

} // namespace

std::size_t Table::indexOf(const std::string& column) const
{
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end())
  {
    throw Error(ErrorCode::BadFile, name + ".csv: no column " + column);
  }
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> Table::column(const std::string& title) const
{
  const std::size_t at = indexOf(title);
  std::vector<double> values;
  for (const auto& row : rows)
  {
    const auto* number = std::get_if<double>(&row[at]);
    if (!number)
    {
      throw Error(ErrorCode::BadFile, name + ".csv: words in column " + title);
    }
    values.push_back(*number);
  }
  return values;
}

std::string textOf(const Cell& cell, int digits)
{
  const auto* number = std::get_if<double>(&cell);
  if (!number)
  {
    return std::get<std::string>(cell);
  }
  if (std::isnan(*number))
  {
    return "";
  }
  return digits > 0 ? formatted(*number, std::chars_format::general, digits) : shortest(*number);
}

std::string shown(const Cell& cell)
{
  const auto* number = std::get_if<double>(&cell);
  if (!number)
  {
    return std::get<std::string>(cell);
  }
  if (!std::isfinite(*number))
  {
    return "\u2013";
  }
  const double size = std::abs(*number);
  if (*number == std::round(*number) && size < 1e9)
  {
    return shortest(*number);
  }
  if (size < 1e-3 || size >= 1e7)
  {
    return formatted(*number, std::chars_format::scientific, 2);
  }
  const int digits = std::clamp(3 - static_cast<int>(std::floor(std::log10(size))), 0, 5);
  return formatted(*number, std::chars_format::fixed, digits);
}

std::string csv(const Table& table, int digits)
{
  std::string text;
  const auto add = [&](const std::vector<Cell>& row)
  {
    const char* separator = "";
    for (const Cell& cell : row)
    {
      text.append(separator).append(csvField(textOf(cell, digits)));
      separator = ",";
    }
    text += '\n';
  };
  add({ table.columns.begin(), table.columns.end() });
  std::ranges::for_each(table.rows, add);
  return text;
}

} // namespace palp::figures
