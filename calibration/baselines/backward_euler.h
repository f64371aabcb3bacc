#pragma once

#include "calibration/fem/block_matrix.h"

#include <Eigen/Core>
#include <vector>

namespace palp::fem
{

/// A node whose speed along a direction is given.
struct VelocityConstraint
{
  int node;
  Eigen::Vector3d normal; ///< unit
  double speed;           ///< [m/s]
};

/// The linear system of a step: (M (1 + alpha dt) + K (dt^2 + beta dt)) v = M v0 + dt f.
///
/// Bonded nodes stay, nodes of given speed keep it; the rest is solved by preconditioned conjugate
/// gradients within the motions that remain.
///
/// @source  Baraff and Witkin 1998, Sec. 5.3
class BackwardEuler
{
public:
  /// @param masses  of the nodes [kg]
  /// @param bonded  nodes that stay
  BackwardEuler(const Eigen::VectorXd& masses, std::vector<int> bonded);

  struct System
  {
    const BlockMatrix& stiffness;   // [N/m]
    const Eigen::Matrix3Xd& forces; // [N]
    const std::vector<VelocityConstraint>& given;
    double dt;    // [s]
    double alpha; // [1/s]
    double beta;  // [s]
    int mostIterations;
    double tolerance; // of the residual to |M v0 + dt f| [-]
  };
  struct Solution
  {
    int iterations;
    double residual; // [-]
  };
  /// @param velocity  [m/s] before, and after
  Solution solve(const System& system, Eigen::Matrix3Xd& velocity);

  /// What held the bonded and given nodes in the last solve [N].
  [[nodiscard]] const Eigen::Matrix3Xd& reactions() const noexcept
  {
    return reactions_;
  }

private:
  void apply(const System& system, const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& product) const;
  void restrict(const System& system, Eigen::Matrix3Xd& v) const;

  Eigen::RowVectorXd masses_;
  std::vector<int> bonded_;
  Eigen::Matrix3Xd load_, residual_, direction_, product_, scaled_, inverseDiagonal_, reactions_;
};

} // namespace palp::fem
