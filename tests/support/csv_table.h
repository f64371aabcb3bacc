#pragma once

#include "tests/support/process.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace palp::test
{

/// Columns of a CSV by name; comment lines that begin with # are kept apart.
struct CsvTable
{
  std::vector<std::string> comments;
  std::map<std::string, std::vector<double>> columns;

  [[nodiscard]] const std::vector<double>& operator[](const std::string& name) const
  {
    static const std::vector<double> kNone;
    const auto found = columns.find(name);
    EXPECT_NE(found, columns.end()) << "no column " << name;
    return found == columns.end() ? kNone : found->second;
  }
};

inline CsvTable parseCsv(std::istream& in)
{
  CsvTable table;
  std::vector<std::string> names;
  std::string line;
  while (std::getline(in, line))
  {
    if (line.starts_with('#'))
    {
      table.comments.push_back(line);
      continue;
    }
    std::istringstream cells(line);
    std::string cell;
    std::size_t k = 0;
    const bool header = names.empty();
    while (std::getline(cells, cell, ','))
    {
      if (header)
      {
        names.push_back(cell);
      }
      else if (k < names.size())
      {
        table.columns[names[k++]].push_back(std::stod(cell));
      }
    }
    EXPECT_TRUE(header || k == names.size()) << "a short row: " << line;
  }
  return table;
}

inline CsvTable readCsv(const std::filesystem::path& file)
{
  std::ifstream in(file);
  EXPECT_TRUE(in.good()) << file;
  return parseCsv(in);
}

/// A file of a text, in a folder of its own.
inline std::filesystem::path writtenCsv(const std::string& text)
{
  const auto file = freshFolder() / "table.csv";
  std::ofstream(file) << text;
  return file;
}

} // namespace palp::test
