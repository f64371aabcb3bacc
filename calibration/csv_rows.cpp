#include "calibration/csv_rows.h"

#include "haptics/error.h"
#include "haptics/force/number_table.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>

namespace palp
{
namespace
{

// the first line that is no comment
std::string headerOf(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::string line;
  do
  {
    std::getline(in, line);
    line.erase(std::find(line.begin(), line.end(), '\r'), line.end());
  } while (in && (line.empty() || line.front() == '#'));
  return line;
}

} // namespace

std::vector<std::vector<double>> readCsv(const std::filesystem::path& file, std::size_t columns)
{
  const std::string header = headerOf(file);
  const NumberTable table = NumberTable::readFinite(file, header);
  const auto names = static_cast<std::size_t>(std::ranges::count(header, ',')) + 1;
  if (names != columns || std::isalpha(static_cast<unsigned char>(header.front())) == 0)
  {
    throw Error(ErrorCode::BadFile,
      file.string() + ": no header; begin with the names of " + std::to_string(columns) +
        " columns");
  }
  std::vector<std::vector<double>> rows;
  for (const NumberTable::Row& row : table.rows)
  {
    rows.push_back(row.values);
  }
  return rows;
}

} // namespace palp
