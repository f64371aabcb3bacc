#include "haptics/surface/sampling/place_grid.h"

#include "haptics/error.h"
#include "haptics/surface/sampling/area_darts.h"
#include "haptics/surface/sampling/point_cells.h"
#include "haptics/units.h"

#include <algorithm>
#include <random>

namespace palp
{
namespace
{

constexpr double kDarts = 40.0; // in a square of the spacing; fewer leave gaps

} // namespace

std::vector<SurfacePoint> placeGrid(
  const Surface& surface, double spacing, const std::optional<MapRegion>& region)
{
  std::mt19937_64 engine{ 1 };
  const auto mayBeIn = [&](std::size_t triangle)
  {
    const auto [a, b, c] = cornersOf(surface, triangle);
    const double size = std::max((b - a).norm(), (c - a).norm());
    return !region || (a - region->center).norm() <= region->radius + size;
  };
  const AreaDarts darts(surface, mayBeIn);
  std::vector<SurfacePoint> places;
  PointCells cells(spacing);
  const double count = kDarts * darts.area() / (spacing * spacing);
  constexpr double kPerPlace = 0.6; // of a place, of the square of the spacing, at least
  if (!(count * kPerPlace <= kDarts * kMostPlaces))
  {
    throw Error(ErrorCode::BadValue,
      "a spacing of " + units::inMillimeters(spacing) + " gives more than " +
        std::to_string(kMostPlaces) + " places; give a larger one, or a smaller region");
  }
  for (double i = 0.0; i < std::max(count, kDarts) && darts.area() > 0.0; ++i)
  {
    const SurfacePoint dart = darts.next(engine);
    bool isFree = !region || (dart.position - region->center).norm() <= region->radius;
    cells.near(dart.position,
      [&](std::size_t k)
      {
        const bool isNear = (places[k].position - dart.position).norm() < spacing;
        isFree = isFree && !(isNear && areBeside(places[k], dart));
      });
    if (isFree)
    {
      cells.add(places.size(), dart.position);
      places.push_back(dart);
    }
  }
  if (places.empty())
  {
    throw Error(ErrorCode::BadValue,
      "no surface lies in the region of the map; give another place, or a larger radius");
  }
  return places;
}

} // namespace palp
