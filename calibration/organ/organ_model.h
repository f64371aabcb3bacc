#pragma once

#include "calibration/organ/cubes/cube_moduli.h"
#include "calibration/organ/node_weights.h"
#include "haptics/surface/surface.h"

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>

namespace palp
{

/// Where a body rests.
struct Support
{
  std::function<bool(const Eigen::Vector3d&)>
    holds;                                         ///< whether it holds a place of the surface [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero(); ///< unit; the body slides across it; 0: bonded
};

/// Displacements of a body of linear material, in cubes that are cut by its surface.
///
/// The stiffness of a cut cube is that of its part inside; those with less than a thirtieth of it
/// inside are left out. Supports hold the surface itself: its mean displacement in each cube.
class OrganModel
{
public:
  /// @param surface        closed
  /// @param side           of the cubes [m]
  /// @param youngModulus   [Pa]
  /// @param poissonRatio   0 to below 0.5, everywhere [-]
  /// @param ratio          of its moduli; empty: the same everywhere
  /// @throws Error         BadMesh: the surface is open or crosses itself; BadValue: the supports
  ///                       leave a motion free, and which; no cube is filled; more would be than
  ///                       the machine has memory for, or than 20 million
  OrganModel(const Surface& surface, double side, double youngModulus, double poissonRatio,
    std::span<const Support> supports, const ModulusRatio& ratio = {});
  ~OrganModel();
  OrganModel(OrganModel&&) noexcept;
  OrganModel& operator=(OrganModel&&) noexcept;

  using Weights = NodeWeights;

  /// A place near the surface; in a cube that is filled by less it is extrapolated from the next
  /// one inwards.
  /// @param outward  unit
  /// @return         false where no such cube is within 2.5 sides
  [[nodiscard]] bool weightsAt(const Eigen::Vector3d& place, const Eigen::Vector3d& outward,
    Weights& weights, double filled = 0.5) const;

  /// Whether a bonded support is so near beside a place that cubes do not tell what it holds.
  /// @param outward  unit
  [[nodiscard]] bool isBesideSupport(
    const Eigen::Vector3d& place, const Eigen::Vector3d& outward) const noexcept;

  using Moved = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>; ///< by place [m]

  /// Adds what supports pull that have moved themselves.
  /// @param forces  x, y, z of node after node [N]
  void moveSupports(Eigen::Ref<Eigen::VectorXd> forces, const Moved& supports) const;

  [[nodiscard]] const CubeModuli& moduli() const noexcept;
  [[nodiscard]] const ModulusRatio& ratio() const noexcept; ///< as given

  /// Adds what a field of displacements needs that is without load in a body that is even.
  /// @param forces  x, y, z of node after node [N]
  /// @param ratio   of that body's modulus to that of the whole [-]
  void varyLoad(Eigen::Ref<Eigen::VectorXd> forces, const Moved& field, double ratio) const;

  /// @param forces    a column for each load; x, y, z of node after node [N]
  /// @return          displacements of the nodes, likewise [m]
  /// @throws Error    NoSolution: out of memory
  /// @threadsafe      each thread for itself
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& forces) const;

  [[nodiscard]] int nodes() const noexcept;
  [[nodiscard]] double leftOut() const noexcept; ///< of the volume: pieces by themselves [-]
  [[nodiscard]] double side() const noexcept;
  [[nodiscard]] double contactModulus() const noexcept; ///< E* [Pa]
  [[nodiscard]] double shearModulus() const noexcept;   ///< [Pa]
  [[nodiscard]] double poissonRatio() const noexcept;   ///< [-]

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace palp
