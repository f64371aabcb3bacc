#include "calibration/csv_rows.h"

#include "haptics/error.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <string>

namespace palp
{

std::vector<std::vector<double>> readCsv(const std::filesystem::path& file, std::size_t columns)
{
  std::ifstream in(file);
  if (!in)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be opened; name a table file");
  }
  std::vector<std::vector<double>> rows;
  std::string header;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line)
  {
    if (text.empty() || text[0] == '#')
    {
      continue;
    }
    if (header.empty())
    {
      header = text;
      continue;
    }
    std::vector<double> row;
    const char* at = text.data();
    const char* end = at + text.size();
    for (double value = 0.0; row.size() < columns; ++at)
    {
      const auto [next, error] = std::from_chars(at, end, value);
      row.push_back(value);
      const bool last = row.size() == columns;
      if (error != std::errc{} || !std::isfinite(value) ||
        (last ? next != end : next == end || *next != ','))
      {
        throw Error(ErrorCode::BadFile,
          file.string() + ":" + std::to_string(line) + ": expected numbers for " + header);
      }
      at = next;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

} // namespace palp
