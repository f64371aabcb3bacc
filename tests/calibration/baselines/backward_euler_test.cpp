#include "calibration/baselines/backward_euler.h"

#include "calibration/baselines/tet_mesh.h"

#include <Eigen/LU>
#include <gtest/gtest.h>
#include <random>

namespace palp::fem
{
namespace
{

using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTimeStep = 0.3;
constexpr double kAlpha = 0.4;
constexpr double kBeta = 0.2;

// of nodes as a mesh joins them, in springs of any direction
BlockMatrix randomSprings(const TetMesh& mesh, std::mt19937& random)
{
  BlockMatrix stiffness(static_cast<int>(mesh.positions.cols()), mesh.tets);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (Eigen::Matrix3d& block : stiffness.blocks())
  {
    const Vector3d d(any(random), any(random), any(random));
    block = -d * d.transpose(); // a spring
  }
  stiffness.balance();
  return stiffness;
}

MatrixXd denseSystem(const BlockMatrix& stiffness, const VectorXd& masses)
{
  const auto size = 3 * static_cast<int>(masses.size());
  MatrixXd a(size, size);
  for (int i = 0; i < size; ++i)
  {
    Matrix3Xd unit = Matrix3Xd::Zero(3, masses.size());
    unit.reshaped()[i] = 1.0;
    Matrix3Xd column(3, masses.size());
    stiffness.multiply(unit, column);
    a.col(i) = kTimeStep * (kTimeStep + kBeta) * column.reshaped();
    a(i, i) += (1.0 + kAlpha * kTimeStep) * masses[i / 3];
  }
  return a;
}

// by elimination: speeds, then multipliers of the bonded nodes and of the given speeds
VectorXd denseSolution(const MatrixXd& a, const VectorXd& load, const std::vector<int>& bonded,
  const std::vector<VelocityConstraint>& given)
{
  const Eigen::Index size = a.rows();
  const auto constraints = static_cast<Eigen::Index>(3 * bonded.size() + given.size());
  MatrixXd kkt = MatrixXd::Zero(size + constraints, size + constraints);
  VectorXd right = VectorXd::Zero(size + constraints);
  kkt.topLeftCorner(size, size) = a;
  right.head(size) = load;
  Eigen::Index row = size;
  const auto hold = [&](int node, const Vector3d& along, double speed)
  {
    kkt.block<1, 3>(row, 3 * node) = along.transpose();
    kkt.block<3, 1>(3 * node, row) = along;
    right[row++] = speed;
  };
  for (const int i : bonded)
  {
    for (int c = 0; c < 3; ++c)
    {
      hold(i, Vector3d::Unit(c), 0.0);
    }
  }
  for (const VelocityConstraint& g : given)
  {
    hold(g.node, g.normal, g.speed);
  }
  return kkt.fullPivLu().solve(right);
}

// against dense elimination in the motions that are left
TEST(BackwardEuler, SolvesTheConstrainedSystem)
{
  const TetMesh mesh = blockTets(1.0, 1.0, 3, 3);
  const auto nodes = static_cast<int>(mesh.positions.cols());
  std::mt19937 random(1);
  const BlockMatrix stiffness = randomSprings(mesh, random);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const auto randomField = [&]
  {
    Matrix3Xd field(3, nodes);
    for (double& x : field.reshaped())
    {
      x = any(random);
    }
    return field;
  };
  const Matrix3Xd forces = randomField();
  const Matrix3Xd before = randomField();
  const VectorXd masses = VectorXd::LinSpaced(nodes, 0.5, 1.5);
  const std::vector<VelocityConstraint> given{ { 20, Vector3d(1, 2, -1).normalized(), 0.7 },
    { 26, Vector3d(0, 0, -1), -0.3 } };

  BackwardEuler euler(masses, mesh.bonded);
  Matrix3Xd v = before;
  const auto solution = euler.solve({ .stiffness = stiffness,
                                      .forces = forces,
                                      .given = given,
                                      .dt = kTimeStep,
                                      .alpha = kAlpha,
                                      .beta = kBeta,
                                      .mostIterations = 500,
                                      .tolerance = 1e-13 },
    v);
  EXPECT_LE(solution.residual, 1e-13);

  const VectorXd load = (before * masses.asDiagonal() + kTimeStep * forces).reshaped();
  const VectorXd exact = denseSolution(denseSystem(stiffness, masses), load, mesh.bonded, given);
  EXPECT_LT(
    (v.reshaped() - exact.head(load.size())).norm(), 1e-10 * exact.head(load.size()).norm());
  // multipliers push the other way and act for dt
  EXPECT_NEAR(
    given[0].normal.dot(euler.reactions().col(20)), -exact[exact.size() - 2] / kTimeStep, 1e-9);
  EXPECT_NEAR(
    given[1].normal.dot(euler.reactions().col(26)), -exact[exact.size() - 1] / kTimeStep, 1e-9);
}

} // namespace
} // namespace palp::fem
