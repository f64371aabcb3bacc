#pragma once

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace palp::test
{

/// One row of a table in data/reference: text by column.
class ReferenceRow
{
public:
  explicit ReferenceRow(std::map<std::string, std::string> cells)
    : cells_(std::move(cells))
  {
  }

  [[nodiscard]] const std::string& text(const std::string& column) const
  {
    return cells_.at(column);
  }

  [[nodiscard]] double number(const std::string& column) const
  {
    return std::stod(cells_.at(column));
  }

private:
  std::map<std::string, std::string> cells_;
};

/// All rows of data/reference/NAME.csv; none where the file is missing, so that tests must check.
inline std::vector<ReferenceRow> referenceTable(const std::string& name)
{
  std::ifstream stream(PALP_SOURCE_DIR "/data/reference/" + name + ".csv");
  std::vector<std::string> header;
  std::vector<ReferenceRow> rows;
  std::string line;
  while (std::getline(stream, line))
  {
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    std::vector<std::string> cells;
    std::istringstream text(line + ",");
    for (std::string cell; std::getline(text, cell, ',');)
    {
      cells.push_back(cell);
    }
    if (header.empty())
    {
      header = cells;
      continue;
    }
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < header.size(); ++i)
    {
      row[header[i]] = i < cells.size() ? cells[i] : "";
    }
    rows.emplace_back(std::move(row));
  }
  return rows;
}

} // namespace palp::test
