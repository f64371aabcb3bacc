#include "calibration/organ/support_grip.h"

#include "haptics/error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <string>

namespace palp
{

void SupportGrip::add(const NodeWeights& more, const Eigen::Vector3d& middle, double part)
{
  weights.nodes = more.nodes;
  for (std::size_t i = 0; i < more.values.size(); ++i)
  {
    weights.values[i] += part * more.values[i];
  }
  place += part * middle;
  area += part;
}

void SupportGrip::divide()
{
  for (double& value : weights.values)
  {
    value /= area;
  }
  place /= area;
}

Eigen::Matrix3d SupportGrip::direction() const
{
  return along.isZero() ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                        : Eigen::Matrix3d(along * along.transpose());
}

void checkHeld(std::span<const SupportGrip> grips, double size)
{
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  for (const SupportGrip& grip : grips)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d way = grip.direction().col(axis);
      Eigen::Matrix<double, 6, 1> row;
      row << way, (grip.place - grips.front().place).cross(way) / size;
      held += row * row.transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(held);
  constexpr double least = 1e-9;
  if (solver.eigenvalues()[0] > least * std::max(1e-300, solver.eigenvalues()[5]))
  {
    return;
  }
  Eigen::Index motion = 0;
  solver.eigenvectors().col(0).cwiseAbs().maxCoeff(&motion);
  throw Error(ErrorCode::BadValue,
    std::string("the supports leave the body free to ") +
      (motion < 3 ? "move along " : "turn about ") + "xyz"[motion % 3] + "; add one that holds it");
}

} // namespace palp
