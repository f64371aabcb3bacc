#pragma once

#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <optional>
#include <vector>

namespace palp
{

/// The part of a surface that lies in a ball.
struct MapRegion
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< [m]
  double radius = 0.03;                             ///< [m]
};

constexpr std::size_t kMostPlaces = 20'000; ///< of a grid

/// Whether two places of a surface are on the same side of the body.
[[nodiscard]] inline bool areBeside(const SurfacePoint& a, const SurfacePoint& b)
{
  return a.normal.dot(b.normal) > 0.0;
}

/// Places spread evenly over a surface, a Poisson disk: no two of a side are nearer to each other
/// than the spacing, and next to no point is farther than that from all of them; none is on the
/// wall of a hollow. The same surface gives the same places.
///
/// @param spacing  along the straight line [m], above 0
/// @param region   none: the whole surface
/// @throws Error   BadValue: more than kMostPlaces, or none in the region
/// @source         Cook, ACM TOG 5(1), 1986: dart throwing, here over triangles by their area
[[nodiscard]] std::vector<SurfacePoint> placeGrid(
  const Surface& surface, double spacing, const std::optional<MapRegion>& region = std::nullopt);

} // namespace palp
