#pragma once

#include "calibration/elasticity.h"
#include "calibration/tet_mesh.h"
#include "haptics/material.h"

namespace palp::fem
{

/// A spring along every edge of the tetrahedra.
///
/// The six springs of an element are those whose strain energy differs least, over all its modes,
/// from that of the linear element with the same E and with nu = 1/4, the only one springs have.
/// For a regular element that is k = (2 sqrt 2 / 25) E L. A spring that would have to push more as
/// it gets longer is left out.
///
/// @source  Lloyd, Szekely and Harders 2007
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
