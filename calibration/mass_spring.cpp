#include "calibration/mass_spring.h"

#include <algorithm>
#include <cmath>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

} // namespace

MassSprings::MassSprings(const TetMesh& mesh, const BlockMatrix& matrix, const Material& material)
  : constants_(matrix.edges().size(), 0.0)
{
  for (const BlockMatrix::Edge& edge : matrix.edges())
  {
    lengths_.push_back((mesh.positions.col(edge.j) - mesh.positions.col(edge.i)).norm());
  }
  for (std::array<int, 4> nodes : mesh.tets)
  {
    std::sort(nodes.begin(), nodes.end());
    const double part = material.youngModulus * volume(mesh.positions, nodes);
    for (std::size_t a = 0; a < 4; ++a)
    {
      for (std::size_t b = a + 1; b < 4; ++b)
      {
        const auto edge = static_cast<std::size_t>(matrix.edgeBetween(nodes[a], nodes[b]));
        constants_[edge] += part / (lengths_[edge] * lengths_[edge]);
      }
    }
  }
}

double MassSprings::respond(
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
  stiffness.balance();
  return energy;
}

} // namespace palp::fem
