#include "calibration/organ/cube_stiffness.h"

#include <cmath>
#include <vector>

namespace palp
{
namespace
{

using Gradients = Eigen::Matrix<double, 3, kCubeCorners>;

// of the trilinear shape functions of the unit cube [0, 1]^3
Gradients gradientsAt(const Eigen::Vector3d& at)
{
  Gradients gradients;
  for (int corner = 0; corner < kCubeCorners; ++corner)
  {
    Eigen::Vector3d value;
    Eigen::Vector3d slope;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool high = ((corner >> axis) & 1) != 0;
      value[axis] = high ? at[axis] : 1.0 - at[axis];
      slope[axis] = high ? 1.0 : -1.0;
    }
    gradients.col(corner) << slope.x() * value.y() * value.z(), value.x() * slope.y() * value.z(),
      value.x() * value.y() * slope.z();
  }
  return gradients;
}

// over points of the unit cube that stand for equal parts of a volume
CubeStiffness integrated(double side, double youngModulus, double poissonRatio,
  const std::vector<Eigen::Vector3d>& points, double volume)
{
  const double shear = youngModulus / (2.0 * (1.0 + poissonRatio));
  const double bulk = youngModulus / (3.0 * (1.0 - 2.0 * poissonRatio));
  const double part = volume / static_cast<double>(points.size());
  CubeStiffness stiffness = CubeStiffness::Zero();
  Eigen::Matrix<double, 1, 24> dilated = Eigen::Matrix<double, 1, 24>::Zero();
  for (const Eigen::Vector3d& point : points)
  {
    const Gradients gradients = gradientsAt(point) / side;
    Eigen::Matrix<double, 6, 24> strain = Eigen::Matrix<double, 6, 24>::Zero();
    for (int corner = 0; corner < kCubeCorners; ++corner)
    {
      const Eigen::Vector3d g = gradients.col(corner);
      strain.block<6, 3>(0, 3L * corner) << g.x(), 0, 0, 0, g.y(), 0, 0, 0, g.z(), //
        g.y(), g.x(), 0, 0, g.z(), g.y(), g.z(), 0, g.x();
    }
    const Eigen::Matrix<double, 1, 24> dilatation = strain.topRows<3>().colwise().sum();
    dilated += part * dilatation;
    strain.topRows<3>().rowwise() -= dilatation / 3.0;
    Eigen::Matrix<double, 6, 1> moduli;
    moduli << Eigen::Vector3d::Constant(2.0 * shear), Eigen::Vector3d::Constant(shear);
    stiffness += part * strain.transpose() * moduli.asDiagonal() * strain;
  }
  return stiffness + bulk / volume * dilated.transpose() * dilated;
}

} // namespace

CubeStiffness cubeStiffness(double side, double youngModulus, double poissonRatio)
{
  const double gauss = 0.5 / std::sqrt(3.0);
  std::vector<Eigen::Vector3d> points;
  points.reserve(kCubeCorners);
  for (int point = 0; point < kCubeCorners; ++point)
  {
    points.emplace_back(0.5 + ((point & 1) != 0 ? gauss : -gauss),
      0.5 + ((point & 2) != 0 ? gauss : -gauss), 0.5 + ((point & 4) != 0 ? gauss : -gauss));
  }
  return integrated(side, youngModulus, poissonRatio, points, side * side * side);
}

CubeStiffness cutCubeStiffness(
  double side, double youngModulus, double poissonRatio, const CubePoints& inside)
{
  std::vector<Eigen::Vector3d> points;
  points.reserve(inside.count());
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    if (inside[i])
    {
      const auto part = static_cast<int>(i);
      const int row = part / kCubeParts;
      const int layer = row / kCubeParts;
      points.emplace_back((Eigen::Vector3d(part % kCubeParts, row % kCubeParts, layer) +
                            Eigen::Vector3d::Constant(0.5)) /
        kCubeParts);
    }
  }
  const double filled = static_cast<double>(points.size()) / static_cast<double>(inside.size());
  // what holds nodes far from the body may not resist where the body moves as a whole
  constexpr double least = 1e-5;
  return integrated(side, youngModulus, poissonRatio, points, filled * side * side * side) +
    least * cubeStiffness(side, youngModulus, poissonRatio);
}

} // namespace palp
