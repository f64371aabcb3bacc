#pragma once

#include "calibration/baselines/tet_mesh.h"
#include "calibration/fem/elasticity.h"
#include "haptics/material.h"

namespace palp::fem
{

/// A spring along every edge of the tetrahedra.
///
/// k = E sum(V) / L^2 over the elements around an edge: averaged over directions, the body has the
/// given E, and nu = 1/4, the only one that springs have. In one direction it is stiffer or softer.
///
/// Springs alone let elements turn inside out where they are pressed by about a third. Where asked,
/// every element also holds its volume by kappa/2 (V/V0 - 1)^2 V0 with kappa = lambda - mu, and the
/// springs take E = 5/2 mu: then the body has the given nu as well, 1/4 or more.
///
/// @source  springs: Van Gelder 1998; volume: Golec et al. 2020
class MassSprings final : public Elasticity
{
public:
  /// @param mesh      checked
  /// @param matrix    of the same mesh: its edges are the springs
  /// @param material  E; and nu where volumes are held
  MassSprings(
    const TetMesh& mesh, const BlockMatrix& matrix, const Material& material, bool holdVolumes);

  double evaluate(
    const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness) override;

private:
  struct Cell
  {
    std::array<int, 4> nodes; // ascending
    std::array<int, 6> edges;
    double sixfold; // six times the volume at rest, signed [m^3]
  };
  double holdVolumes(const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces,
    std::vector<Eigen::Matrix3d>& blocks) const;

  std::vector<Cell> cells_;       // none where volumes are free
  double bulk_ = 0.0;             // kappa [Pa]
  std::vector<double> constants_; // [N/m]
  std::vector<double> lengths_;   // at rest [m]
};

} // namespace palp::fem
