#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace palp
{

/// Bare triangles, without what a Surface knows besides.
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> points; ///< [m]
  std::vector<Triangle> triangles;     ///< indices into points
};

/// The same shape with fewer points, each one of those given: for the haptic side.
///
/// Of our own in the choice of edges alone: OpenMesh's decimaters ask at each step for the topology
/// and the normals of all edges nearby, which takes ten times as long.
///
/// @param points     finite [m]
/// @param triangles  indices in range
/// @param count      of points that are left, or more where topology, triangles that would turn
///                   over or become slivers, or the error do not allow it; 4 or more
/// @param error      by which a point may be off the planes of the triangles that it stands for,
///                   root mean square [m]
/// @return           closed where the surface is
/// @throws Error     BadMesh: an edge with more than two triangles, or triangles of opposite sense
/// @source           Garland and Heckbert, "Surface simplification using quadric error metrics",
///                   1997
[[nodiscard]] TriangleMesh decimated(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::size_t count,
  double error = std::numeric_limits<double>::infinity());

/// The same at several numbers of points, for the time of the fewest.
///
/// @param counts  each at most the one before it
/// @param take    gets a mesh for each, as decimated() makes it; false: the rest is not wanted
void decimateTo(std::span<const std::size_t> counts, std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, double error, const std::function<bool(TriangleMesh)>& take);

} // namespace palp
