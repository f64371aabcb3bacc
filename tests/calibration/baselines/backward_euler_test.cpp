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

// against dense elimination in the motions that are left
TEST(BackwardEuler, SolvesTheConstrainedSystem)
{
  const TetMesh mesh = blockTets(1.0, 1.0, 3, 3);
  const auto nodes = static_cast<int>(mesh.positions.cols());
  BlockMatrix stiffness(nodes, mesh.tets);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (Eigen::Matrix3d& block : stiffness.blocks())
  {
    const Vector3d d(any(random), any(random), any(random));
    block = -d * d.transpose(); // a spring
  }
  stiffness.balance();
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
  const std::vector<GivenSpeed> given{ { 20, Vector3d(1, 2, -1).normalized(), 0.7 },
    { 26, Vector3d(0, 0, -1), -0.3 } };
  const double dt = 0.3;
  const double alpha = 0.4;
  const double beta = 0.2;

  BackwardEuler euler(masses, mesh.bonded);
  Matrix3Xd v = before;
  const auto solution = euler.solve({ .stiffness = stiffness,
                                      .forces = forces,
                                      .given = given,
                                      .dt = dt,
                                      .alpha = alpha,
                                      .beta = beta,
                                      .mostIterations = 500,
                                      .tolerance = 1e-13 },
    v);
  EXPECT_LE(solution.residual, 1e-13);

  const int size = 3 * nodes;
  MatrixXd a(size, size);
  for (int i = 0; i < size; ++i)
  {
    Matrix3Xd unit = Matrix3Xd::Zero(3, nodes);
    unit.reshaped()[i] = 1.0;
    Matrix3Xd column(3, nodes);
    stiffness.multiply(unit, column);
    a.col(i) = dt * (dt + beta) * column.reshaped();
    a(i, i) += (1.0 + alpha * dt) * masses[i / 3];
  }
  const auto constraints = static_cast<int>(3 * mesh.bonded.size() + given.size());
  MatrixXd kkt = MatrixXd::Zero(size + constraints, size + constraints);
  VectorXd right = VectorXd::Zero(size + constraints);
  kkt.topLeftCorner(size, size) = a;
  right.head(size) = (before * masses.asDiagonal() + dt * forces).reshaped();
  int row = size;
  const auto hold = [&](int node, const Vector3d& along, double speed)
  {
    kkt.block<1, 3>(row, 3 * node) = along.transpose();
    kkt.block<3, 1>(3 * node, row) = along;
    right[row++] = speed;
  };
  for (const int i : mesh.bonded)
  {
    for (int c = 0; c < 3; ++c)
    {
      hold(i, Vector3d::Unit(c), 0.0);
    }
  }
  for (const GivenSpeed& g : given)
  {
    hold(g.node, g.normal, g.speed);
  }
  const VectorXd exact = kkt.fullPivLu().solve(right);
  EXPECT_LT((v.reshaped() - exact.head(size)).norm(), 1e-10 * exact.head(size).norm());
  // multipliers push the other way and act for dt
  EXPECT_NEAR(
    given[0].normal.dot(euler.reactions().col(20)), -exact[size + constraints - 2] / dt, 1e-9);
  EXPECT_NEAR(
    given[1].normal.dot(euler.reactions().col(26)), -exact[size + constraints - 1] / dt, 1e-9);
}

} // namespace
} // namespace palp::fem
