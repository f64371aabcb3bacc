#pragma once

#include "calibration/organ/cubes/cut_grid.h"

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

namespace palp
{

/// Young's modulus of a body at a place, over that of the whole [-]; where it is not above 0 or not
/// finite it is that of the whole.
using ModulusRatio = std::function<double(const Eigen::Vector3d&)>;

/// The moduli of cubes over that of the whole body: the geometric mean over the points inside each,
/// so that a border between two tissues may run through it.
class CubeModuli
{
public:
  /// Everywhere the same.
  CubeModuli() = default;

  /// @param grid   which has to outlive this
  /// @param cubes  of the grid, that count
  CubeModuli(const CutGrid& grid, std::span<const Cube> cubes, const ModulusRatio& ratio);

  /// Of cube after cube; empty: everywhere the same.
  [[nodiscard]] std::span<const double> ratios() const noexcept
  {
    return ratios_;
  }
  [[nodiscard]] double largest() const noexcept;

  /// The geometric mean within a distance [m]; 1 where no cube is that counts.
  [[nodiscard]] double around(const Eigen::Vector3d& place, double distance) const noexcept;

private:
  const CutGrid* grid_ = nullptr;
  std::vector<double> ratios_{};
  std::vector<double> all_{}; // of the whole grid; 0: of a cube that does not count
};

} // namespace palp
