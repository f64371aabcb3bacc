#pragma once

#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <vector>

namespace palp
{

/// Triangles before anything is computed from them.
struct Mesh
{
  std::vector<Eigen::Vector3d> points; ///< [m]
  std::vector<Triangle> triangles;
};

/// The paper's regular surface: n x n points in the plane z = 0, centered, facing +z.
///
/// n^2 points, (3 n - 1)(n - 1) edges, 2 (n - 1)^2 triangles.
///
/// @param n       2 or more
/// @param size    side of the square [m]
/// @source        Sec. 4.2, Table 1
[[nodiscard]] Mesh makeGrid(int n, double size);

/// Closed block whose top is centered at the origin, facing +z.
///
/// @param size     along x, y and z [m]
/// @param spacing  largest distance of neighbors along an axis [m]
[[nodiscard]] Mesh makeBox(const Eigen::Vector3d& size, double spacing);

/// Geodesic sphere about the origin: an icosahedron split k times, 10 4^k + 2 points.
///
/// @param radius  of the points [m]; the triangles lie a little inside
/// @param splits  k, 0 to 8
[[nodiscard]] Mesh makeSphere(double radius, int splits);

} // namespace palp
