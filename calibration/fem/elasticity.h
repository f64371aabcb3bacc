#pragma once

#include "calibration/fem/block_matrix.h"

#include <Eigen/Core>

namespace palp::fem
{

/// What a body made of tetrahedra answers to the positions of its nodes.
class Elasticity
{
public:
  virtual ~Elasticity() = default;

  /// Forces, energy, and a stiffness that is never negative, as the conjugate gradients need it.
  ///
  /// @param positions  of all nodes [m]
  /// @param forces     on them: minus the gradient of the energy [N]
  /// @param stiffness  of the body's edges, balanced [N/m]; where the body is undeformed, or
  ///                   turned as a whole, the second derivative of the energy
  /// @return           the energy [J]
  virtual double evaluate(
    const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness) = 0;

  /// Forgets what was kept from earlier calls to start from.
  virtual void reset()
  {
  }
};

} // namespace palp::fem
