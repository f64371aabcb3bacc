#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

namespace palp
{

/// How a surface bends at a place.
struct Curvature
{
  double mean = 0.0;   ///< of the principal curvatures [1/m], convex positive
  double spread = 0.0; ///< half their difference [1/m], 0 or more
};

/// Curvature tensors of the points of a surface, on the scale of its edges [1/m].
///
/// Each is the best fit to the curvatures along the edges about a point, averaged twice with its
/// neighbours; symmetric, in the frame of the points, with the mean curvature along the normal, so
/// that it may be interpolated.
///
/// @param points      [m]
/// @param normals     of the points, outward; zero where a point has no triangle
/// @param neighbours  of a point, by edges
/// @source            Taubin, "Estimating the tensor of curvature of a surface from a polyhedral
///                    approximation", ICCV 1995
[[nodiscard]] std::vector<Eigen::Matrix3f> curvatureTensors(std::span<const Eigen::Vector3d> points,
  std::span<const Eigen::Vector3d> normals,
  const std::function<std::span<const int>(int)>& neighbours);

/// @param tensor  of curvatureTensors, or a mean of some
/// @param normal  unit vector
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Curvature curvatureAcross(
  const Eigen::Matrix3d& tensor, const Eigen::Vector3d& normal) noexcept;

} // namespace palp
