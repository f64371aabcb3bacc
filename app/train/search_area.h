#pragma once

#include "haptics/surface/surface.h"
#include "haptics/surface/surface_point.h"

#include <Eigen/Core>
#include <vector>

namespace palp
{

class AreaDarts;

/// The part of a body's surface that is searched: what faces a side within 60 degrees.
struct SearchArea
{
  static constexpr std::size_t kPoints = 20'000; ///< to which an area is known within 1 %

  double area;                      ///< [m^2]
  std::vector<SurfacePoint> points; ///< spread over it by chance, the same each time

  /// The part of it whose points lie so near to a place [-].
  [[nodiscard]] double fractionWithin(const Eigen::Vector3d& place, double radius) const;
};

/// Random places of what is searched.
/// @param surface  outlives what is returned
/// @param side     outward, of any length but 0
/// @throws Error   BadValue: none of the surface faces it
[[nodiscard]] AreaDarts dartsFacing(const Surface& surface, const Eigen::Vector3d& side);

/// @throws Error  as dartsFacing
[[nodiscard]] SearchArea searchAreaOf(const Surface& surface, const Eigen::Vector3d& side);

} // namespace palp
