#pragma once

#include <Eigen/Core>

namespace palp
{

/// Unit force spread over the surface of a half-space by 5 c^5 / (2 pi (r^2 + c^2)^(7/2)), and what
/// it does below: smooth, so that what a body does otherwise can be told by coarse cubes.
///
/// @source  Boussinesq's potentials of sources above the surface, and two derivatives by their
///          height; Johnson, Contact Mechanics, 1985, Eqs. (3.2) to (3.5)
struct SmoothPressure
{
  double radius;  ///< c [m]
  double shear;   ///< modulus [Pa]
  double poisson; ///< [-]

  /// [Pa/N] at a distance from the middle [m]
  [[nodiscard]] double at(double distance) const noexcept;

  /// Distance within which a part of the force is, 0 to below 1 [m].
  [[nodiscard]] double radiusOf(double part) const noexcept;

  /// @param place  x and y along the surface, z down, from the middle; z > -c below the axis [m]
  /// @return       [m/N]
  [[nodiscard]] Eigen::Vector3d displacement(const Eigen::Vector3d& place) const noexcept;

  /// [Pa/N] at such a place; by differences of the displacement
  [[nodiscard]] Eigen::Matrix3d stress(const Eigen::Vector3d& place) const noexcept;
};

} // namespace palp
