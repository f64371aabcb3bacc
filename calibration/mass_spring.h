#pragma once

#include "calibration/elasticity.h"
#include "calibration/tet_mesh.h"
#include "haptics/material.h"

namespace palp::fem
{

/// A spring along every edge of the tetrahedra.
///
/// k = E sum(V) / L^2 over the elements around an edge: averaged over directions, the body has the
/// given E, and nu = 1/4, the only one that springs have. In one direction it is stiffer or softer.
///
/// @source  Van Gelder 1998
class MassSprings final : public Elasticity
{
public:
  /// @param mesh      checked
  /// @param matrix    of the same mesh: its edges are the springs
  /// @param material  E is used, nu is not
  MassSprings(const TetMesh& mesh, const BlockMatrix& matrix, const Material& material);

  double respond(
    const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness) override;

  /// Of each edge of the matrix [N/m].
  [[nodiscard]] const std::vector<double>& constants() const noexcept
  {
    return constants_;
  }

private:
  std::vector<double> constants_; // [N/m]
  std::vector<double> lengths_;   // at rest [m]
};

} // namespace palp::fem
