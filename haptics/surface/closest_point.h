#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>

namespace palp
{

/// Point of a surface that is nearest to a place.
struct ClosestPoint
{
  int triangle = -1;                               ///< -1: none within reach
  Eigen::Vector3d point = Eigen::Vector3d::Zero(); ///< on the triangles [m]
  double distance = 0.0;                           ///< [m], negative inside the body
};

/// The nearest point of the triangles, and on which side of them a place is: by the nearest
/// feature, or, of a surface that crosses itself, by all of it.
///
/// Beside an open edge the inside ends gradually: behind the plane of the sheet, the distance
/// past its edge counts against the depth.
///
/// @param reach   farthest distance of interest [m]; infinity to find always
/// @source        Ericson, Real-Time Collision Detection, 5.1.5; Baerentzen and Aanaes 2005
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] ClosestPoint findClosestPoint(
  const Surface& surface, const Eigen::Vector3d& position, double reach) noexcept;

/// Distance to the nearest of the triangles, whatever side of them a place is on; the reach where
/// none is nearer [m].
/// @param reach   as above
/// @param enough  where a triangle is as near, the distance of any such is told, which is quicker
///                [m]
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] double distanceTo(
  const BoxTree& tree, const Eigen::Vector3d& position, double reach, double enough = 0.0) noexcept;

} // namespace palp
