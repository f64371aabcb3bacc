#include "calibration/tables/extent_table.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>

namespace palp
{
namespace
{
constexpr double kMost = 1000.0; // [mm] of R_d
}

ExtentTable ExtentTable::read(const std::filesystem::path& file)
{
  std::vector<Extent> rows;
  for (const auto& [values, line] : NumberTable::readFinite(file, kHeader).rows)
  {
    if (!(values[1] >= 0.0 && values[1] <= kMost))
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + shortest(values[1]) + " mm is no radius of a dent; give 0 to " +
          shortest(kMost) + " mm");
    }
    rows.push_back({ .depth = units::fromMillimeters(values[0]),
      .extentRadius = units::fromMillimeters(values[1]),
      .force = values[2],
      .contactRadius = units::fromMillimeters(values[3]) });
  }
  try
  {
    return ExtentTable(std::move(rows));
  }
  catch (const Error& error)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": " + error.what());
  }
}

ExtentTable::ExtentTable(std::vector<Extent> rows)
  : rows_(std::move(rows))
{
  const auto notIncreasing = [](const Extent& a, const Extent& b) { return !(a.depth < b.depth); };
  if (rows_.size() < 2 || !(rows_.front().depth > 0.0) ||
    std::adjacent_find(rows_.begin(), rows_.end(), notIncreasing) != rows_.end())
  {
    throw Error(ErrorCode::BadValue,
      "an R_d table needs two rows or more with increasing depths; calibrate again");
  }
}

double ExtentTable::extentRadius(double depth) const noexcept
{
  if (!(depth > 0.0))
  {
    return 0.0;
  }
  const auto above = std::lower_bound(rows_.begin(), rows_.end(), depth,
    [](const Extent& row, double value) { return row.depth < value; });
  if (above == rows_.end())
  {
    return rows_.back().extentRadius;
  }
  const Extent below = above == rows_.begin() ? Extent{} : *(above - 1);
  const double t = (depth - below.depth) / (above->depth - below.depth);
  return below.extentRadius + t * (above->extentRadius - below.extentRadius);
}

} // namespace palp
