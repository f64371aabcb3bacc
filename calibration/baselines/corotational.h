#pragma once

#include "calibration/baselines/tet_mesh.h"
#include "calibration/fem/elasticity.h"
#include "haptics/material.h"

#include <Eigen/Geometry>

namespace palp::fem
{

/// Linear tetrahedra, each linear in a frame that turns with it.
///
/// W = mu |F - R|^2 + lambda/2 (tr U - 3)^2, R the rotation of F: its gradient is exact; its
/// stiffness leaves out how R turns, which keeps it from becoming negative.
///
/// @source  Mueller and Gross 2004; R: Newton's method on the axis of R^T F, from the last step's R
class CorotationalTets final : public Elasticity
{
public:
  /// @param mesh      checked
  /// @param matrix    of the same mesh
  CorotationalTets(const TetMesh& mesh, const BlockMatrix& matrix, const Material& material);

  double evaluate(
    const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness) override;
  void reset() override;

private:
  struct Tet
  {
    std::array<int, 4> nodes; // ascending
    std::array<int, 6> edges;
    Eigen::Matrix3d slopes; // of the shape functions of nodes 1 to 3, in columns [1/m]
    double volume;          // [m^3]
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  };
  std::vector<Tet> tets_;
  double lambda_; // [Pa]
  double mu_;     // [Pa]
};

/// The rotation that is nearest to F, found from one near it.
/// @param gradient  F; where it is inside out, the proper rotation that leaves
///                  its shortest stretch negative
[[nodiscard]] Eigen::Quaterniond nearestRotation(
  const Eigen::Matrix3d& gradient, const Eigen::Quaterniond& from);

} // namespace palp::fem
