#include "app/train/search_area.h"

#include "haptics/error.h"
#include "haptics/surface/sampling/area_darts.h"
#include "haptics/units.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{

using namespace units::literals;

double SearchArea::fractionWithin(const Eigen::Vector3d& place, double radius) const
{
  const auto near = [&](const SurfacePoint& point)
  { return (point.position - place).norm() <= radius; };
  return static_cast<double>(std::ranges::count_if(points, near)) /
    static_cast<double>(points.size());
}

AreaDarts dartsFacing(const Surface& surface, const Eigen::Vector3d& side)
{
  const double least = std::cos(60.0_deg) * side.norm();
  AreaDarts darts(surface,
    [&](std::size_t triangle)
    {
      const auto [a, b, c] = cornersOf(surface, triangle);
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      return normal.dot(side) >= least * normal.norm();
    });
  if (!(darts.area() > 0.0))
  {
    throw Error(ErrorCode::BadValue,
      "training: no part of the surface faces its side; give another --side, as in 0,0,1");
  }
  return darts;
}

SearchArea searchAreaOf(const Surface& surface, const Eigen::Vector3d& side)
{
  const AreaDarts darts = dartsFacing(surface, side);
  std::mt19937_64 engine{ 1 };
  SearchArea area{ .area = darts.area(), .points = {} };
  area.points.reserve(SearchArea::kPoints);
  while (area.points.size() < SearchArea::kPoints)
  {
    area.points.push_back(darts.next(engine));
  }
  return area;
}

} // namespace palp
