#include "calibration/baselines/mass_spring.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace palp::fem
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

MassSprings::MassSprings(
  const TetMesh& mesh, const BlockMatrix& matrix, const Material& material, bool holdVolumes)
  : constants_(matrix.edges().size(), 0.0)
{
  const double mu = material.shearModulus();
  const double lambda = 2.0 * mu * material.poissonRatio / (1.0 - 2.0 * material.poissonRatio);
  const double young = holdVolumes ? 2.5 * mu : material.youngModulus;
  bulk_ = lambda - mu;
  for (const BlockMatrix::Edge& edge : matrix.edges())
  {
    lengths_.push_back((mesh.positions.col(edge.j) - mesh.positions.col(edge.i)).norm());
  }
  for (const std::array<int, 4>& nodes : mesh.tets)
  {
    Cell cell{ .nodes = nodes, .edges = {}, .sixfold = 0.0 };
    std::sort(cell.nodes.begin(), cell.nodes.end());
    cell.sixfold = edgesOf(mesh.positions, cell.nodes).determinant();
    cell.edges = matrix.edgesOf(cell.nodes);
    for (const int e : cell.edges)
    {
      const auto edge = static_cast<std::size_t>(e);
      constants_[edge] += young * std::abs(cell.sixfold) / (6.0 * lengths_[edge] * lengths_[edge]);
    }
    if (holdVolumes)
    {
      cells_.push_back(cell);
    }
  }
}

double MassSprings::evaluate(
  const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness)
{
  forces.setZero();
  std::vector<Matrix3d>& blocks = stiffness.blocks();
  double energy = 0.0;
  for (std::size_t e = 0; e < blocks.size(); ++e)
  {
    const auto [i, j] = stiffness.edges()[e];
    const Vector3d span = positions.col(j) - positions.col(i);
    const double length = std::max(span.norm(), 1e-9 * lengths_[e]);
    const Vector3d direction = span / length;
    const double stretch = length - lengths_[e];
    energy += 0.5 * constants_[e] * stretch * stretch;
    const Vector3d pull = constants_[e] * stretch * direction;
    forces.col(i) += pull;
    forces.col(j) -= pull;

    // a shortened spring would give way sideways: that part is left out
    const double across = constants_[e] * std::max(0.0, stretch / length);
    blocks[e].noalias() = (across - constants_[e]) * direction * direction.transpose();
    blocks[e].diagonal().array() -= across;
  }
  energy += holdVolumes(positions, forces, blocks);
  stiffness.balance();
  return energy;
}

double MassSprings::holdVolumes(
  const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, std::vector<Matrix3d>& blocks) const
{
  double energy = 0.0;
  for (const Cell& cell : cells_)
  {
    const Matrix3d edges = edgesOf(positions, cell.nodes);
    Eigen::Matrix<double, 3, 4> slopes; // of V / V0 to the nodes [1/m]
    slopes.col(1) = edges.col(1).cross(edges.col(2)) / cell.sixfold;
    slopes.col(2) = edges.col(2).cross(edges.col(0)) / cell.sixfold;
    slopes.col(3) = edges.col(0).cross(edges.col(1)) / cell.sixfold;
    slopes.col(0) = -slopes.rightCols<3>().rowwise().sum();
    const double swelling = edges.col(0).dot(slopes.col(1)) - 1.0;
    const double stiffness = bulk_ * std::abs(cell.sixfold) / 6.0;
    energy += 0.5 * stiffness * swelling * swelling;
    std::size_t e = 0;
    for (int a = 0; a < 4; ++a)
    {
      forces.col(cell.nodes[static_cast<std::size_t>(a)]) -= stiffness * swelling * slopes.col(a);
      const Vector3d scaled = stiffness * slopes.col(a);
      for (int b = a + 1; b < 4; ++b)
      {
        Matrix3d& block = blocks[static_cast<std::size_t>(cell.edges[e++])];
        for (int c = 0; c < 3; ++c)
        {
          block.col(c) += slopes(c, b) * scaled;
        }
      }
    }
  }
  return energy;
}

} // namespace palp::fem
