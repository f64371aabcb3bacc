#include "app/calibration.h"

#include "app/data_files.h"

#include <string>

namespace palp
{
namespace
{

// sizes that tables are shipped for; beyond them the nearest one stands in
std::string bundledTable(const Tip& tip)
{
  constexpr double kBetween = 0.008; // [m], between the two radii of sphere and cone
  const bool small = baseRadius(tip) < kBetween;
  if (std::holds_alternative<ConeTip>(tip) || std::holds_alternative<BluntConeTip>(tip))
  {
    return small ? "tables/cone45_r6_h30" : "tables/cone45_r10_h50";
  }
  return small ? "tables/sphere_r6_h30" : "tables/sphere_r10_h50";
}

} // namespace

Calibration loadCalibration(const PressOptions& options, const Tip& tip)
{
  const std::string bundled = bundledTable(tip);
  Calibration calibration{ .extents = ExtentTable::read(
                             options.table.empty() ? dataFile(bundled + ".csv") : options.table),
    .surfaces = std::nullopt };
  if (options.surface == "fitted")
  {
    calibration.surfaces = FittedSurfaces::read(dataFile(bundled + "_surface.csv"));
  }
  return calibration;
}

} // namespace palp
