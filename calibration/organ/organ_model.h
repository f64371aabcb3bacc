#pragma once

#include "calibration/organ/cut_grid.h"

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace palp
{

/// Where a body rests.
struct Support
{
  std::function<bool(const Eigen::Vector3d&)> holds; ///< whether it holds the body at a place [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero();   ///< unit; the body slides across it; 0: bonded
};

/// Displacements of a body of one linear material, in cubes that are cut by its surface.
///
/// The stiffness of a cut cube is that of its part inside; those with less than a thirtieth of it
/// inside are left out.
class OrganModel
{
public:
  /// @param grid           of the body
  /// @param youngModulus   [Pa]
  /// @param poissonRatio   0 to below 0.5 [-]
  /// @param supports       that hold the nodes of the cubes where they hold
  /// @throws Error         BadValue: the supports leave a motion free, and which
  OrganModel(
    CutGrid grid, double youngModulus, double poissonRatio, std::span<const Support> supports);
  ~OrganModel();
  OrganModel(OrganModel&&) noexcept;
  OrganModel& operator=(OrganModel&&) noexcept;

  /// Forces on places near the surface, as a linear combination of the nodes' displacements: the
  /// column for each gives the displacement there along a direction.
  ///
  /// A place in a cube that is filled by less than half is extrapolated from the next one inwards.
  /// @param outward  unit
  /// @return         empty where no such cube is within 2.5 sides
  struct Weights
  {
    std::array<int, 8> nodes;
    std::array<double, 8> values;
  };
  [[nodiscard]] bool weightsAt(
    const Eigen::Vector3d& place, const Eigen::Vector3d& outward, Weights& weights) const;

  /// @param forces  x, y, z of node after node [N], a column for each load
  /// @return        their displacements [m]
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;

  [[nodiscard]] int nodes() const noexcept;
  [[nodiscard]] double side() const noexcept;
  [[nodiscard]] double contactModulus() const noexcept; ///< E* [Pa]

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace palp
