#include "app/curves/force_curve.h"

#include "app/input/tip_text.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace palp
{
namespace
{

constexpr std::string_view kTool = "# tool: ";
constexpr const char* kLocal = "local_depth_mm";

ForceRows rowsIn(const std::filesystem::path& file, const char* depth)
{
  const NumberTable table = NumberTable::readRecording(file, std::array{ depth, "force_N" });
  if (table.rows.empty())
  {
    throw Error(ErrorCode::BadFile, file.string() + ": no row below the header; give a curve");
  }
  ForceRows rows{ .curve = { .name = file.stem().string(), .x = {}, .y = {} },
    .recorded = std::ranges::find(table.names, "time_s") != table.names.end(),
    .tool = {},
    .isInBody = std::ranges::find(table.names, kLocal) != table.names.end() };
  const auto tool = std::ranges::find_if(
    table.comments, [](const std::string& line) { return line.starts_with(kTool); });
  if (tool != table.comments.end())
  {
    rows.tool = tool->substr(kTool.size());
  }
  for (const auto& [values, line] : table.rows)
  {
    rows.curve.x.push_back(units::fromMillimeters(values[0]));
    rows.curve.y.push_back(values[1]);
  }
  return rows;
}

} // namespace

ForceRows readForceRows(const std::filesystem::path& file)
{
  return rowsIn(file, "depth_mm");
}

ForceRows readContactRows(const std::filesystem::path& file)
{
  ForceRows rows = readForceRows(file);
  return rows.isInBody ? rowsIn(file, kLocal) : rows;
}

std::string noteOfTool(const ForceRows& rows, const Tip& tip)
{
  const std::string taken = describeTip(tip);
  return rows.tool.empty() || rows.tool == taken
    ? ""
    : "was recorded with the tool " + printable(rows.tool) + " and is taken as one of " + taken;
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
