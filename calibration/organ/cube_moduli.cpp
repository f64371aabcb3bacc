#include "calibration/organ/cube_moduli.h"

#include "calibration/organ/cube_stiffness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace palp
{
namespace
{

double meanOf(
  const CubePoints& inside, const Eigen::Vector3d& corner, double side, const ModulusRatio& ratio)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < CubePoints::size(); ++i)
  {
    const double here = inside[i] ? ratio(corner + side * inside.middle[i].cast<double>()) : 1.0;
    sum += here > 0.0 && std::isfinite(here) ? inside.part[i] * std::log(here) : 0.0;
  }
  return std::exp(sum / static_cast<double>(CubePoints::size()) / inside.filled());
}

std::size_t indexOf(const Cube& cube, const Cube& size)
{
  return (static_cast<std::size_t>(cube[2]) * static_cast<std::size_t>(size[1]) +
           static_cast<std::size_t>(cube[1])) *
    static_cast<std::size_t>(size[0]) +
    static_cast<std::size_t>(cube[0]);
}

Eigen::Vector3d cornerOf(const Cube& cube)
{
  return { static_cast<double>(cube[0]), static_cast<double>(cube[1]),
    static_cast<double>(cube[2]) };
}

} // namespace

CubeModuli::CubeModuli(const CutGrid& grid, std::span<const Cube> cubes, const ModulusRatio& ratio)
  : all_(static_cast<std::size_t>(grid.size()[0]) * static_cast<std::size_t>(grid.size()[1]) *
        static_cast<std::size_t>(grid.size()[2]),
      std::numeric_limits<double>::quiet_NaN())
  , low_(grid.low())
  , size_(grid.size())
  , side_(grid.side())
{
  ratios_.reserve(cubes.size());
  for (const Cube& cube : cubes)
  {
    const Eigen::Vector3d corner = low_ + side_ * cornerOf(cube);
    ratios_.push_back(meanOf(grid.inside(cube), corner, side_, ratio));
    all_[indexOf(cube, size_)] = ratios_.back();
  }
}

double CubeModuli::largest() const noexcept
{
  return ratios_.empty() ? 1.0 : *std::ranges::max_element(ratios_);
}

Cube CubeModuli::cubeAt(const Eigen::Vector3d& place) const noexcept
{
  const Eigen::Vector3d cell = ((place - low_) / side_).array().floor();
  return { static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()) };
}

double CubeModuli::of(const Cube& cube) const noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (cube[axis] < 0 || cube[axis] >= size_[axis])
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  return all_[indexOf(cube, size_)];
}

double CubeModuli::around(const Eigen::Vector3d& place, double distance) const noexcept
{
  const Cube low = cubeAt(place - Eigen::Vector3d::Constant(distance));
  const Cube high = cubeAt(place + Eigen::Vector3d::Constant(distance));
  double sum = 0.0;
  double weights = 0.0;
  Cube cube{};
  for (cube[2] = low[2]; cube[2] <= high[2]; ++cube[2])
  {
    for (cube[1] = low[1]; cube[1] <= high[1]; ++cube[1])
    {
      for (cube[0] = low[0]; cube[0] <= high[0]; ++cube[0])
      {
        const Eigen::Vector3d middle =
          low_ + side_ * (cornerOf(cube) + Eigen::Vector3d::Constant(0.5));
        const double rest = 1.0 - (middle - place).squaredNorm() / (distance * distance);
        if (const double ratio = of(cube); rest > 0.0 && std::isfinite(ratio))
        {
          sum += rest * std::log(ratio);
          weights += rest;
        }
      }
    }
  }
  return weights > 0.0 ? std::exp(sum / weights) : 1.0;
}

} // namespace palp
