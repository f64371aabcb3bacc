#include "app/map/place_grid.h"

#include "app/map/point_cells.h"
#include "haptics/error.h"
#include "haptics/surface/facet_part.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace palp
{
namespace
{

constexpr double kDarts = 40.0; // in a square of the spacing; fewer leave gaps

// 0 for those of the outside, where a tool gets
std::vector<float> hollowsOf(const Surface& surface)
{
  std::vector<std::array<int, 3>> across;
  for (int i = 0; at(i) < surface.triangles().size(); ++i)
  {
    across.push_back({ surface.across(i, 0), surface.across(i, 1), surface.across(i, 2) });
  }
  return hollowRadii({ surface.points(), surface.triangles(), across });
}

// triangles by their area, of those that may have a part in the region
class Darts
{
public:
  Darts(const Surface& surface, const std::optional<MapRegion>& region)
    : surface_(surface)
  {
    const std::vector<float> hollows = hollowsOf(surface);
    for (std::size_t i = 0; i < surface.triangles().size(); ++i)
    {
      if (hollows[i] > 0.0F)
      {
        continue;
      }
      const auto [a, b, c] = corners(i);
      const double size = std::max((b - a).norm(), (c - a).norm());
      if (!region || (a - region->center).norm() <= region->radius + size)
      {
        area_ += 0.5 * (b - a).cross(c - a).norm();
        triangles_.push_back(i);
        sums_.push_back(area_);
      }
    }
  }

  [[nodiscard]] double area() const
  {
    return area_;
  }

  [[nodiscard]] SurfacePoint next()
  {
    const double share = area_ * random();
    const auto at = std::min(std::ranges::upper_bound(sums_, share) - sums_.begin(),
      static_cast<std::ptrdiff_t>(sums_.size()) - 1);
    const std::size_t triangle = triangles_[static_cast<std::size_t>(at)];
    const auto [a, b, c] = corners(triangle);
    const double root = std::sqrt(random());
    const double across = random();
    const Eigen::Vector3d position =
      (1.0 - root) * a + root * (1.0 - across) * b + root * across * c;
    return surfacePoint(surface_, static_cast<int>(triangle), position);
  }

private:
  struct Corners
  {
    Eigen::Vector3d a, b, c;
  };

  [[nodiscard]] Corners corners(std::size_t triangle) const
  {
    const Triangle& points = surface_.triangles()[triangle];
    const auto point = [&](std::size_t k)
    { return surface_.points()[static_cast<std::size_t>(points[k])]; };
    return { point(0), point(1), point(2) };
  }

  // 0 to 1, the same on every machine
  double random()
  {
    return static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }

  const Surface& surface_;
  double area_ = 0.0;
  std::vector<std::size_t> triangles_;
  std::vector<double> sums_; // of the areas so far
  std::mt19937_64 engine_{ 1 };
};

} // namespace

std::vector<SurfacePoint> placeGrid(
  const Surface& surface, double spacing, const std::optional<MapRegion>& region)
{
  Darts darts(surface, region);
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
    const SurfacePoint dart = darts.next();
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
