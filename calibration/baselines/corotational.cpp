#include "calibration/baselines/corotational.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kMaxTurns = 8;     // of Newton's method for a rotation
constexpr double kTurned = 3e-5; // angle after which the next one is below 1e-9 [rad]
constexpr double kFarTurn = 0.5; // angle beyond which Newton's method is not trusted [rad]

// the rotation of F from its singular values, whatever F is
Quaterniond rotationBySvd(const Matrix3d& gradient)
{
  const Eigen::JacobiSVD<Matrix3d> svd(gradient, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d left = svd.matrixU();
  if (left.determinant() * svd.matrixV().determinant() < 0.0)
  {
    left.col(2) *= -1.0;
  }
  return Quaterniond(Matrix3d(left * svd.matrixV().transpose()));
}

} // namespace

// S = R^T F is symmetric at the solution; turning R by w changes its skew part by (tr S) w - S w
Quaterniond nearestRotation(const Matrix3d& gradient, const Quaterniond& from)
{
  Quaterniond turn = from;
  for (int k = 0; k < kMaxTurns; ++k)
  {
    const Matrix3d s = turn.toRotationMatrix().transpose() * gradient;
    const Vector3d skew(s(2, 1) - s(1, 2), s(0, 2) - s(2, 0), s(1, 0) - s(0, 1));
    const Vector3d w(s(1, 1) + s(2, 2), s(0, 0) + s(2, 2), s(0, 0) + s(1, 1)); // tr S - S, diagonal
    const double yz = -0.5 * (s(2, 1) + s(1, 2));
    const double xz = -0.5 * (s(0, 2) + s(2, 0));
    const double xy = -0.5 * (s(1, 0) + s(0, 1));
    Matrix3d adjugate;
    adjugate << w[1] * w[2] - yz * yz, xz * yz - xy * w[2], xy * yz - xz * w[1], //
      xz * yz - xy * w[2], w[0] * w[2] - xz * xz, xy * xz - yz * w[0],           //
      xy * yz - xz * w[1], xy * xz - yz * w[0], w[0] * w[1] - xy * xy;
    const double determinant = adjugate.row(0).dot(Vector3d(w[0], xy, xz));
    // positive definite where the nearest rotation is the only one nearby
    if (!(w[0] > 0.0 && adjugate(2, 2) > 0.0 && determinant > 0.0))
    {
      break;
    }
    const Vector3d by = adjugate * skew / determinant;
    const double squaredAngle = by.squaredNorm();
    if (!(squaredAngle < kFarTurn * kFarTurn))
    {
      break;
    }
    turn = turn * Quaterniond(1.0, 0.5 * by[0], 0.5 * by[1], 0.5 * by[2]);
    turn.normalize();
    if (squaredAngle < kTurned * kTurned)
    {
      return turn;
    }
  }
  return rotationBySvd(gradient);
}

CorotationalTets::CorotationalTets(
  const TetMesh& mesh, const BlockMatrix& matrix, const Material& material)
  : mu_(material.shearModulus())
{
  lambda_ = 2.0 * mu_ * material.poissonRatio / (1.0 - 2.0 * material.poissonRatio);
  tets_.reserve(mesh.tets.size());
  for (const std::array<int, 4>& nodes : mesh.tets)
  {
    Tet tet;
    tet.nodes = nodes;
    std::sort(tet.nodes.begin(), tet.nodes.end());
    const Matrix3d edges = edgesOf(mesh.positions, tet.nodes);
    tet.volume = std::abs(edges.determinant()) / 6.0;
    tet.slopes = edges.inverse().transpose();
    tet.edges = matrix.edgesOf(tet.nodes);
    tets_.push_back(tet);
  }
}

double CorotationalTets::evaluate(
  const Eigen::Matrix3Xd& positions, Eigen::Matrix3Xd& forces, BlockMatrix& stiffness)
{
  forces.setZero();
  std::vector<Matrix3d>& blocks = stiffness.blocks();
  std::fill(blocks.begin(), blocks.end(), Matrix3d::Zero());
  double energy = 0.0;
  for (Tet& tet : tets_)
  {
    const Matrix3d gradient = edgesOf(positions, tet.nodes) * tet.slopes.transpose();
    tet.turn = nearestRotation(gradient, tet.turn);
    const Matrix3d rotation = tet.turn.toRotationMatrix();
    const Matrix3d strain = gradient - rotation; // turned into the present frame
    const double dilatation = (rotation.transpose() * gradient).trace() - 3.0;
    energy += tet.volume * (mu_ * strain.squaredNorm() + 0.5 * lambda_ * dilatation * dilatation);

    const Matrix3d stress = 2.0 * mu_ * strain + lambda_ * dilatation * rotation;
    const Matrix3d pull = tet.volume * stress * tet.slopes;
    forces.col(tet.nodes[0]) += pull.rowwise().sum();
    forces.col(tet.nodes[1]) -= pull.col(0);
    forces.col(tet.nodes[2]) -= pull.col(1);
    forces.col(tet.nodes[3]) -= pull.col(2);

    // the stiffness of the linear element between turned slopes
    Eigen::Matrix<double, 3, 4> slope;
    slope.rightCols<3>() = rotation * tet.slopes;
    slope.col(0) = -slope.rightCols<3>().rowwise().sum();
    const double l = tet.volume * lambda_;
    const double m = tet.volume * mu_;
    std::size_t e = 0;
    for (int a = 0; a < 4; ++a)
    {
      for (int b = a + 1; b < 4; ++b)
      {
        Matrix3d& block = blocks[static_cast<std::size_t>(tet.edges[e++])];
        const Vector3d la = l * slope.col(a);
        const Vector3d ma = m * slope.col(a);
        for (int c = 0; c < 3; ++c)
        {
          block.col(c) += slope(c, b) * la + ma[c] * slope.col(b);
        }
        block.diagonal().array() += ma.dot(slope.col(b));
      }
    }
  }
  stiffness.balance();
  return energy;
}

void CorotationalTets::reset()
{
  for (Tet& tet : tets_)
  {
    tet.turn.setIdentity();
  }
}

} // namespace palp::fem
