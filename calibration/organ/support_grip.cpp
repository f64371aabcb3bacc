#include "calibration/organ/support_grip.h"

#include "haptics/error.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace palp
{
namespace
{

using Motions = Eigen::Matrix<double, 6, 6>; // along x, y and z, and turns about them

// about the middle of what holds it
Motions stiffnessOf(std::span<const SupportGrip> grips, double size)
{
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const SupportGrip& grip : grips)
  {
    middle += grip.place / static_cast<double>(grips.size());
  }
  Motions sum = Motions::Zero();
  for (const SupportGrip& grip : grips)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d way = grip.direction().col(axis);
      Eigen::Matrix<double, 6, 1> row;
      row << way, (grip.place - middle).cross(way) / size;
      sum += row * row.transpose();
    }
  }
  return sum;
}

std::string inWords(const Eigen::Vector3d& way)
{
  Eigen::Index most = 0;
  way.cwiseAbs().maxCoeff(&most);
  std::ostringstream text;
  text.precision(2);
  const Eigen::Vector3d turned = way[most] < 0.0 ? Eigen::Vector3d(-way) : way;
  text << "the direction " << turned.x() << ',' << turned.y() << ',' << turned.z();
  return text.str();
}

// the motions that are left free, for people; empty: none
std::string freeMotionOf(std::span<const SupportGrip> grips, double size)
{
  constexpr double kHeldLeast = 1e-9;
  constexpr double kThisOne = 0.99; // of a motion, from which on it is this one
  const Eigen::SelfAdjointEigenSolver<Motions> solver(stiffnessOf(grips, size));
  const auto isFree = [&](Eigen::Index i)
  { return !(solver.eigenvalues()[i] > kHeldLeast * std::max(1e-300, solver.eigenvalues()[5])); };
  Motions free = Motions::Zero();
  Eigen::Index count = 0;
  for (; count < free.rows() && isFree(count); ++count)
  {
    free += solver.eigenvectors().col(count) * solver.eigenvectors().col(count).transpose();
  }
  std::string moves;
  std::string turns;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, "xyz"[axis]);
    moves += free(axis, axis) > kThisOne ? (moves.empty() ? "" : ", ") + name : "";
    turns += free(axis + 3, axis + 3) > kThisOne ? (turns.empty() ? "" : ", ") + name : "";
  }
  if (count > 0 && moves.empty() && turns.empty())
  {
    const Eigen::VectorXd motion = solver.eigenvectors().col(0);
    const bool isTurn = motion.tail<3>().norm() > motion.head<3>().norm();
    (isTurn ? turns : moves) = inWords((isTurn ? motion.tail<3>() : motion.head<3>()).normalized());
  }
  return (moves.empty() ? "" : "move along " + moves) +
    (moves.empty() || turns.empty() ? "" : " and ") + (turns.empty() ? "" : "turn about " + turns);
}

} // namespace

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
  if (const std::string motion = freeMotionOf(grips, size); !motion.empty())
  {
    throw Error(ErrorCode::BadValue,
      "the supports, in " + std::to_string(grips.size()) +
        (grips.size() == 1 ? " cell" : " cells") + ", leave the body free to " + motion +
        "; add one that holds it, or give smaller cells where it is thinner than two of them");
  }
}

} // namespace palp
