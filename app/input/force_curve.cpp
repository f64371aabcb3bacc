#include "app/input/force_curve.h"

#include "haptics/error.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>

namespace palp
{

ReferenceCurve readForceCurve(const std::filesystem::path& file)
{
  const NumberTable table = NumberTable::readColumns(file, std::array{ "depth_mm", "force_N" });
  if (table.rows.empty())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": no row below the header; give a curve");
  }
  const bool recorded = std::ranges::find(table.names, "time_s") != table.names.end();
  ReferenceCurve curve{ .name = file.stem().string(), .x = {}, .y = {} };
  for (const auto& [values, line] : table.rows)
  {
    const double depth = units::fromMillimeters(values[0]);
    if (!recorded || curve.x.empty() || depth > curve.x.back())
    {
      curve.x.push_back(depth);
      curve.y.push_back(values[1]);
    }
  }
  return curve;
}

} // namespace palp
