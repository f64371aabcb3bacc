#include "calibration/organ/cubes/cube_stiffness.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

// a point of the unit cube, and the volume that it stands for [m^3]
struct Part
{
  Eigen::Vector3d place;
  double volume;
};

CubeStiffness integrated(
  double side, double youngModulus, double poissonRatio, const std::vector<Part>& parts)
{
  const double shear = youngModulus / (2.0 * (1.0 + poissonRatio));
  const double bulk = youngModulus / (3.0 * (1.0 - 2.0 * poissonRatio));
  double volume = 0.0;
  CubeStiffness stiffness = CubeStiffness::Zero();
  Eigen::Matrix<double, 1, 24> dilated = Eigen::Matrix<double, 1, 24>::Zero();
  for (const auto& [place, part] : parts)
  {
    volume += part;
    const Gradients gradients = gradientsAt(place) / side;
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

void CubePoints::set(std::size_t i)
{
  const auto point = static_cast<int>(i);
  const int row = point / kCubeParts;
  const int layer = row / kCubeParts;
  part[i] = 1.0F;
  middle[i] =
    (Eigen::Vector3i(point % kCubeParts, row % kCubeParts, layer).cast<float>().array() + 0.5F) /
    static_cast<float>(kCubeParts);
}

std::size_t CubePoints::count() const noexcept
{
  return static_cast<std::size_t>(
    std::ranges::count_if(part, [](float one) { return one > 0.0F; }));
}

double CubePoints::filled() const noexcept
{
  return std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(kCount);
}

CubeStiffness cubeStiffness(double side, double youngModulus, double poissonRatio)
{
  const double gauss = 0.5 / std::sqrt(3.0);
  std::vector<Part> parts;
  parts.reserve(kCubeCorners);
  for (int point = 0; point < kCubeCorners; ++point)
  {
    parts.push_back(
      { { 0.5 + ((point & 1) != 0 ? gauss : -gauss), 0.5 + ((point & 2) != 0 ? gauss : -gauss),
          0.5 + ((point & 4) != 0 ? gauss : -gauss) },
        side * side * side / kCubeCorners });
  }
  return integrated(side, youngModulus, poissonRatio, parts);
}

CubeStiffness cutCubeStiffness(
  double side, double youngModulus, double poissonRatio, const CubePoints& inside)
{
  constexpr auto count = static_cast<double>(CubePoints::size());
  std::vector<Part> parts;
  parts.reserve(inside.count());
  for (std::size_t i = 0; i < CubePoints::size(); ++i)
  {
    if (inside[i])
    {
      parts.push_back({ inside.middle[i].cast<double>(),
        static_cast<double>(inside.part[i]) * side * side * side / count });
    }
  }
  // what holds nodes far from the body may not resist where the body moves as a whole
  constexpr double least = 1e-5;
  return integrated(side, youngModulus, poissonRatio, parts) +
    least * cubeStiffness(side, youngModulus, poissonRatio);
}

} // namespace palp
