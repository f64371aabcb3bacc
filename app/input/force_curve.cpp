#include "app/input/force_curve.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <utility>

namespace palp
{

ForceRows readForceRows(const std::filesystem::path& file)
{
  const NumberTable table = NumberTable::readColumns(file, std::array{ "depth_mm", "force_N" });
  if (table.rows.empty())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": no row below the header; give a curve");
  }
  ForceRows rows{ .curve = { .name = file.stem().string(), .x = {}, .y = {} },
    .recorded = std::ranges::find(table.names, "time_s") != table.names.end() };
  for (const auto& [values, line] : table.rows)
  {
    rows.curve.x.push_back(units::fromMillimeters(values[0]));
    rows.curve.y.push_back(values[1]);
  }
  return rows;
}

ReferenceCurve readForceCurve(const std::filesystem::path& file)
{
  ForceRows rows = readForceRows(file);
  if (!rows.recorded)
  {
    return std::move(rows.curve);
  }
  ReferenceCurve curve{ .name = rows.curve.name, .x = {}, .y = {} };
  for (std::size_t i = 0; i < rows.curve.x.size(); ++i)
  {
    if (curve.x.empty() || rows.curve.x[i] > curve.x.back())
    {
      curve.x.push_back(rows.curve.x[i]);
      curve.y.push_back(rows.curve.y[i]);
    }
  }
  return curve;
}

} // namespace palp
