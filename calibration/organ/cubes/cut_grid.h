#pragma once

#include "calibration/organ/cubes/cube_stiffness.h"
#include "haptics/surface/surface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace palp
{

using Cube = std::array<int, 3>; ///< its place in a grid, x, y, z

/// Cubes over a body, each with the part of it that is inside.
class CutGrid
{
public:
  /// @param surface  closed
  /// @param side     of the cubes [m]
  /// @throws Error   BadMesh: the surface is open or crosses itself; BadValue: more than 20 million
  ///                 cubes
  CutGrid(const Surface& surface, double side);

  [[nodiscard]] double side() const noexcept
  {
    return side_;
  }
  [[nodiscard]] const Cube& size() const noexcept
  {
    return size_;
  }
  [[nodiscard]] const Eigen::Vector3d& low() const noexcept
  {
    return low_;
  }

  [[nodiscard]] bool contains(const Cube& cube) const noexcept
  {
    return std::min({ cube[0], cube[1], cube[2] }) >= 0 && cube[0] < size_[0] &&
      cube[1] < size_[1] && cube[2] < size_[2];
  }

  /// What of a cube is inside the body; nothing outside the grid.
  [[nodiscard]] const CubePoints& inside(const Cube& cube) const noexcept;

  /// Part of a cube that is inside the body, 0 to 1.
  [[nodiscard]] double filled(const Cube& cube) const noexcept
  {
    return inside(cube).filled();
  }

  /// In which cube a place is [m]; it may be outside the grid.
  [[nodiscard]] Cube cubeAt(const Eigen::Vector3d& place) const noexcept
  {
    const Eigen::Vector3d cell = ((place - low_) / side_).array().floor();
    return { static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()) };
  }

  /// The corner of a cube at which its numbers stand [m].
  [[nodiscard]] Eigen::Vector3d cornerOf(const Cube& cube) const noexcept
  {
    return low_ + side_ * Eigen::Vector3d(cube[0], cube[1], cube[2]);
  }

  /// Calls for each cube of the grid in which places of a box are [m].
  template <typename Each>
  void forEach(const Eigen::Vector3d& low, const Eigen::Vector3d& high, const Each& each) const
  {
    Cube first = cubeAt(low);
    Cube last = cubeAt(high);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = std::max(0, first[axis]);
      last[axis] = std::min(size_[axis] - 1, last[axis]);
    }
    Cube cube{};
    for (cube[2] = first[2]; cube[2] <= last[2]; ++cube[2])
    {
      for (cube[1] = first[1]; cube[1] <= last[1]; ++cube[1])
      {
        for (cube[0] = first[0]; cube[0] <= last[0]; ++cube[0])
        {
          each(cube);
        }
      }
    }
  }

  /// Of a cube of the grid, among all of them.
  [[nodiscard]] std::size_t indexOf(const Cube& cube) const noexcept
  {
    return (at(cube[2]) * at(size_[1]) + at(cube[1])) * at(size_[0]) + at(cube[0]);
  }

private:
  void fill(const Surface& surface);

  double side_;
  Eigen::Vector3d low_; // corner of the grid [m]
  Cube size_{};
  std::vector<int> kinds_;      // of each cube: empty, whole or which of those that are cut
  std::vector<CubePoints> cut_; // by the surface
};

} // namespace palp
