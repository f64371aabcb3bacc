#include "app/press/force_history.h"

#include "haptics/error.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/number_table.h"
#include "haptics/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{

using namespace units::literals;

double ForceHistory::deepest() const noexcept
{
  return std::ranges::max(points, {}, &PressPoint::depth).depth;
}

ForceHistory readForceHistory(const std::filesystem::path& file)
{
  constexpr double kLargest = 1.0; // [m], either side of the surface
  const NumberTable table = NumberTable::readRecording(file, std::array{ "time_s", "depth_mm" });
  ForceHistory history;
  for (const auto& [values, line] : table.rows)
  {
    const PressPoint point{ values[0], units::fromMillimeters(values[1]) };
    if (point.time < 0.0)
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + "time_s is " + shortest(point.time) + "; give times of 0 or more");
    }
    if (!history.points.empty() && !(point.time > history.points.back().time))
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + "time_s is " + shortest(point.time) + " after " +
          shortest(history.points.back().time) + "; give times that increase from row to row");
    }
    if (std::abs(point.depth) > kLargest)
    {
      throw Error(ErrorCode::BadFile,
        where(file, line) + "depth_mm is " + shortest(values[1]) +
          "; give -1000 to 1000, below 0 where the tool is apart");
    }
    history.points.push_back(point);
    history.depthsMm.push_back(values[1]);
  }
  if (history.points.empty())
  {
    throw Error(
      ErrorCode::BadFile, file.string() + ": no row below the header; give the depths of a press");
  }
  return history;
}

std::vector<double> forcesOver(const std::function<ElasticForce(double)>& elastic,
  const PronySeries& relaxation, const ForceHistory& history)
{
  std::vector<double> forces;
  if (relaxation.empty())
  {
    for (const PressPoint& point : history.points)
    {
      forces.push_back(elastic(std::max(0.0, point.depth)).force);
    }
    return forces;
  }
  const ContactRows rows(
    elastic, std::max(history.deepest(), 1.0_um), ContactRows::Softening::Kept);
  return forcesOver(rows, relaxation, history.points);
}

} // namespace palp
