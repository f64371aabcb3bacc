#include "calibration/extent_table.h"

#include "haptics/error.h"
#include "haptics/units.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace palp
{
namespace
{

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& what)
{
  throw Error(ErrorCode::BadFile, file.string() + ":" + std::to_string(line) + ": " + what);
}

// four numbers separated by commas, in the C locale
ExtentTable::Row parseRow(const std::filesystem::path& file, int line, const std::string& text)
{
  std::istringstream in(text);
  in.imbue(std::locale::classic());
  double value[4];
  for (int i = 0; i < 4; ++i)
  {
    char comma = ',';
    if ((i > 0 && !(in >> comma)) || comma != ',' || !(in >> value[i]))
    {
      refuse(file, line, "expected depth_mm,extent_radius_mm,force_N,contact_radius_mm");
    }
  }
  return { .depth = units::fromMillimetres(value[0]),
    .extentRadius = units::fromMillimetres(value[1]),
    .force = value[2],
    .contactRadius = units::fromMillimetres(value[3]) };
}

} // namespace

ExtentTable ExtentTable::read(const std::filesystem::path& file)
{
  std::ifstream in(file);
  if (!in)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be opened; name a table file");
  }
  std::vector<Row> rows;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line)
  {
    if (text.empty() || text[0] == '#' || text.starts_with("depth_mm"))
    {
      continue;
    }
    rows.push_back(parseRow(file, line, text));
    if (rows.size() > 1 && !(rows.back().depth > rows[rows.size() - 2].depth))
    {
      refuse(file, line, "the depth must increase from row to row");
    }
  }
  if (rows.size() < 2)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": fewer than two rows; calibrate again");
  }
  return ExtentTable(std::move(rows));
}

ExtentTable::ExtentTable(std::vector<Row> rows)
  : rows_(std::move(rows))
{
  const auto notIncreasing = [](const Row& a, const Row& b) { return !(a.depth < b.depth); };
  if (rows_.size() < 2 || !(rows_.front().depth > 0.0) ||
    std::adjacent_find(rows_.begin(), rows_.end(), notIncreasing) != rows_.end())
  {
    throw Error(ErrorCode::BadValue, "extent table: needs two rows or more with increasing depths");
  }
}

double ExtentTable::extentRadius(double depth) const noexcept
{
  if (!(depth > 0.0))
  {
    return 0.0;
  }
  const auto above = std::lower_bound(rows_.begin(), rows_.end(), depth,
    [](const Row& row, double value) { return row.depth < value; });
  if (above == rows_.end())
  {
    return rows_.back().extentRadius;
  }
  const Row below = above == rows_.begin() ? Row{} : *(above - 1);
  const double t = (depth - below.depth) / (above->depth - below.depth);
  return below.extentRadius + t * (above->extentRadius - below.extentRadius);
}

} // namespace palp
