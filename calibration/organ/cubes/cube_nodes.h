#pragma once

#include "calibration/organ/cubes/cut_grid.h"

#include <Eigen/Core>
#include <array>
#include <vector>

namespace palp
{

/// The cubes of a body that hang together, most of them, and the nodes at their corners.
///
/// Cubes share a node where the body goes through faces from one to the other, around the corner:
/// what a gap parts is not joined by it, down to gaps as wide as a cube.
class CubeNodes
{
public:
  using Corners = std::array<int, kCubeCorners>; ///< node at each corner of a cube

  /// @param grid   which has to outlive this
  /// @param least  part of a cube that has to be inside the body, for it to count
  CubeNodes(const CutGrid& grid, double least);

  [[nodiscard]] const std::vector<Cube>& cells() const noexcept
  {
    return cells_;
  }

  /// Of each of the cells.
  [[nodiscard]] const std::vector<Corners>& corners() const noexcept
  {
    return corners_;
  }

  /// Of a cube, which may be outside the grid; null: it is none of the cells.
  [[nodiscard]] const Corners* of(const Cube& cube) const noexcept;

  /// Of the nodes [m].
  [[nodiscard]] const std::vector<Eigen::Vector3d>& places() const noexcept
  {
    return places_;
  }

  /// Part of the volume that no cells join to these [-].
  [[nodiscard]] double leftOut() const noexcept
  {
    return leftOut_;
  }

private:
  [[nodiscard]] int numberOf(const Cube& cube) const noexcept; // among the cells
  void findCells(double least);
  void spreadNode(const Cube& cell, int corner);

  const CutGrid& grid_;
  std::vector<Cube> cells_;
  std::vector<int> numbers_; // of each cube of the grid among the cells; -1: of none
  std::vector<Corners> corners_;
  std::vector<Eigen::Vector3d> places_;
  double leftOut_ = 0.0;
};

} // namespace palp
