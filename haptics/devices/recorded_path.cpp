#include "haptics/devices/recorded_path.h"

#include "haptics/error.h"
#include "haptics/force/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>

namespace palp
{
namespace
{

constexpr std::array kColumns{ "time_s", "tool_x_mm", "tool_y_mm", "tool_z_mm", "axis_x", "axis_y",
  "axis_z" };

// the first line that is no remark
std::string headerOf(const std::filesystem::path& file)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": cannot be read; check name and permission");
  }
  std::string line;
  while (std::getline(stream, line) && line.starts_with('#'))
  {
  }
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

// where the columns that make a pose stand in a row
std::array<std::size_t, kColumns.size()> columnsOf(
  const std::filesystem::path& file, const std::string& header)
{
  std::vector<std::string> names;
  std::istringstream text(header);
  for (std::string name; std::getline(text, name, ',');)
  {
    names.push_back(name);
  }
  std::array<std::size_t, kColumns.size()> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const auto found = std::ranges::find(names, kColumns[i]);
    if (found == names.end())
    {
      throw Error(ErrorCode::BadFile,
        file.string() + ": no column " + kColumns[i] +
          "; give a samples.csv that Palp has exported, or play a path as path:FILE");
    }
    columns[i] = static_cast<std::size_t>(found - names.begin());
  }
  return columns;
}

} // namespace

ScriptedPath readRecording(const std::filesystem::path& file)
{
  const std::string header = headerOf(file);
  const auto columns = columnsOf(file, header);
  const NumberTable table = NumberTable::read(file, header);
  std::vector<PathKnot> knots;
  knots.reserve(table.rows.size());
  for (const NumberTable::Row& row : table.rows)
  {
    const auto value = [&](std::size_t i) { return row.values[columns[i]]; };
    knots.push_back({ .time = value(0),
      .apex = { units::fromMillimetres(value(1)), units::fromMillimetres(value(2)),
        units::fromMillimetres(value(3)) },
      .axis = Eigen::Vector3d(value(4), value(5), value(6)) });
  }
  try
  {
    return ScriptedPath(std::move(knots));
  }
  catch (const Error& error)
  {
    throw Error(ErrorCode::BadFile, file.string() + ": " + error.what());
  }
}

} // namespace palp
