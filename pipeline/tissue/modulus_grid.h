#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace palp
{

/// Young's moduli on a grid of points.
class ModulusGrid
{
public:
  /// @param toGrid  from space [m] to the places of the points, each a whole number
  /// @param points  along each axis, 1 or more
  /// @param moduli  [Pa], the first axis running fastest; 0: not known there
  ModulusGrid(
    const Eigen::Affine3d& toGrid, const std::array<int, 3>& points, std::vector<float> moduli);

  /// Of a function on points of a box.
  /// @param spacing  along each axis [m]; wider where the points would be more than kMostPoints
  static ModulusGrid sampled(const Eigen::AlignedBox3d& box, double spacing,
    const std::function<double(const Eigen::Vector3d&)>& modulus);
  static constexpr double kMostPoints = 4e6;

  /// That of the nearest point; not a number where it is not known, or beyond the grid by more than
  /// half a step.
  [[nodiscard]] double nearest(const Eigen::Vector3d& position) const noexcept;

  /// Linear between the points where it is known.
  [[nodiscard]] double between(const Eigen::Vector3d& position) const noexcept;

private:
  [[nodiscard]] double at(const Eigen::Vector3i& point) const noexcept; // 0: not known

  Eigen::Affine3d toGrid_;
  Eigen::Vector3i points_;
  std::vector<float> moduli_;
};

} // namespace palp
