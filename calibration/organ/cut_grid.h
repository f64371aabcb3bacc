#pragma once

#include "calibration/organ/cube_stiffness.h"
#include "haptics/surface/surface.h"

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

  /// What of a cube is inside the body; nothing outside the grid.
  [[nodiscard]] const CubePoints& inside(const Cube& cube) const noexcept;

  /// Part of a cube that is inside the body, 0 to 1.
  [[nodiscard]] double filled(const Cube& cube) const noexcept
  {
    return inside(cube).filled();
  }

  /// The cubes that hang together by their faces, most of them.
  /// @param least  part of one that has to be inside the body, for it to count
  [[nodiscard]] std::vector<Cube> largestPiece(double least) const;

private:
  void fill(const Surface& surface);

  [[nodiscard]] std::size_t indexOf(const Cube& cube) const noexcept
  {
    return (at(cube[2]) * at(size_[1]) + at(cube[1])) * at(size_[0]) + at(cube[0]);
  }

  double side_;
  Eigen::Vector3d low_; // corner of the grid [m]
  Cube size_{};
  std::vector<int> kinds_;      // of each cube: empty, whole or which of those that are cut
  std::vector<CubePoints> cut_; // by the surface
};

} // namespace palp
