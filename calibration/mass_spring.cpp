#include "calibration/mass_spring.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kUniaxial = 1.2; // lambda + 2 mu to E at nu = 1/4 [-]

using Six = Eigen::Matrix<double, 6, 1>;

// least squares over the springs that are kept: those that come out negative are left out
Six fittedConstants(const Eigen::Matrix<double, 6, 3>& edges, double volume, double young)
{
  // a spring's stiffness to strain is k L^2 (d x d) x (d x d), that of the tissue V C
  Eigen::Matrix<double, 6, 6> products;
  Six load;
  for (int e = 0; e < 6; ++e)
  {
    for (int f = 0; f < 6; ++f)
    {
      const double cosine = edges.row(e).normalized().dot(edges.row(f).normalized());
      products(e, f) =
        edges.row(e).squaredNorm() * edges.row(f).squaredNorm() * std::pow(cosine, 4);
    }
    load[e] = volume * kUniaxial * young * edges.row(e).squaredNorm();
  }
  Six constants;
  for (int k = 0; k < 6; ++k)
  {
    constants = products.ldlt().solve(load);
    int least = 0;
    if (constants.minCoeff(&least) >= 0.0)
    {
      break;
    }
    products.row(least).setZero();
    products.col(least).setZero();
    products(least, least) = 1.0;
    load[least] = 0.0;
  }
  return constants.cwiseMax(0.0);
}

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
    Eigen::Matrix<double, 6, 3> edges;
    std::array<int, 6> places{};
    int e = 0;
    for (std::size_t a = 0; a < 4; ++a)
    {
      for (std::size_t b = a + 1; b < 4; ++b, ++e)
      {
        edges.row(e) = (mesh.positions.col(nodes[b]) - mesh.positions.col(nodes[a])).transpose();
        places[static_cast<std::size_t>(e)] = matrix.edgeBetween(nodes[a], nodes[b]);
      }
    }
    const Vector3d a = edges.row(0);
    const Vector3d b = edges.row(1);
    const Vector3d c = edges.row(2);
    const double volume = std::abs(a.cross(b).dot(c)) / 6.0;
    const Six constants = fittedConstants(edges, volume, material.youngModulus);
    for (std::size_t s = 0; s < 6; ++s)
    {
      constants_[static_cast<std::size_t>(places[s])] += constants[static_cast<Eigen::Index>(s)];
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
