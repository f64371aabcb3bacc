#include "calibration/organ/cubes/cube_moduli.h"

#include "calibration/organ/cubes/cube_stiffness.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

} // namespace

CubeModuli::CubeModuli(const CutGrid& grid, std::span<const Cube> cubes, const ModulusRatio& ratio)
  : grid_(&grid)
  , all_(at(grid.size()[0]) * at(grid.size()[1]) * at(grid.size()[2]))
{
  ratios_.reserve(cubes.size());
  for (const Cube& cube : cubes)
  {
    ratios_.push_back(meanOf(grid.inside(cube), grid.cornerOf(cube), grid.side(), ratio));
    all_[grid.indexOf(cube)] = ratios_.back();
  }
}

double CubeModuli::largest() const noexcept
{
  return ratios_.empty() ? 1.0 : *std::ranges::max_element(ratios_);
}

double CubeModuli::around(const Eigen::Vector3d& place, double distance) const noexcept
{
  double sum = 0.0;
  double weights = 0.0;
  const auto add = [&](const Cube& cube)
  {
    const Eigen::Vector3d middle =
      grid_->cornerOf(cube) + Eigen::Vector3d::Constant(0.5 * grid_->side());
    const double rest = 1.0 - (middle - place).squaredNorm() / (distance * distance);
    if (const double ratio = all_[grid_->indexOf(cube)]; rest > 0.0 && ratio > 0.0)
    {
      sum += rest * std::log(ratio);
      weights += rest;
    }
  };
  if (grid_ != nullptr)
  {
    grid_->forEach(place - Eigen::Vector3d::Constant(distance),
      place + Eigen::Vector3d::Constant(distance), add);
  }
  return weights > 0.0 ? std::exp(sum / weights) : 1.0;
}

} // namespace palp
