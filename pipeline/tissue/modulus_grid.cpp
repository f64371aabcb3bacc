#include "pipeline/tissue/modulus_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{

ModulusGrid::ModulusGrid(
  const Eigen::Affine3d& toGrid, const std::array<int, 3>& points, std::vector<float> moduli)
  : toGrid_(toGrid)
  , points_(points.data())
  , moduli_(std::move(moduli))
{
}

ModulusGrid ModulusGrid::sampled(const Eigen::AlignedBox3d& box, double spacing,
  const std::function<double(const Eigen::Vector3d&)>& modulus)
{
  const double step = std::max(spacing, std::cbrt(box.volume() / kMostPoints));
  std::array<int, 3> points{};
  for (int axis = 0; axis < 3; ++axis)
  {
    points[static_cast<std::size_t>(axis)] = static_cast<int>(box.sizes()[axis] / step) + 2;
  }
  std::vector<float> moduli;
  for (int k = 0; k < points[2]; ++k)
  {
    for (int j = 0; j < points[1]; ++j)
    {
      for (int i = 0; i < points[0]; ++i)
      {
        moduli.push_back(static_cast<float>(modulus(box.min() + step * Eigen::Vector3d(i, j, k))));
      }
    }
  }
  Eigen::Affine3d toGrid = Eigen::Affine3d::Identity();
  toGrid.linear() *= 1.0 / step;
  toGrid.translation() = -box.min() / step;
  return { toGrid, points, std::move(moduli) };
}

double ModulusGrid::at(const Eigen::Vector3i& point) const noexcept
{
  if ((point.array() < 0).any() || (point.array() >= points_.array()).any())
  {
    return 0.0;
  }
  const auto wide = point.cast<std::ptrdiff_t>();
  return static_cast<double>(moduli_[static_cast<std::size_t>(
    (wide.z() * points_.y() + wide.y()) * points_.x() + wide.x())]);
}

double ModulusGrid::nearest(const Eigen::Vector3d& position) const noexcept
{
  const Eigen::Vector3d place = toGrid_ * position;
  const double value = at((place.array() + 0.5).floor().cast<int>().matrix());
  return value != 0.0 ? value : std::numeric_limits<double>::quiet_NaN();
}

double ModulusGrid::between(const Eigen::Vector3d& position) const noexcept
{
  const Eigen::Vector3d place = toGrid_ * position;
  const Eigen::Vector3d low = place.array().floor().matrix();
  const Eigen::Vector3d part = place - low;
  double sum = 0.0;
  double known = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3i up(corner & 1, corner >> 1 & 1, corner >> 2);
    const double value = at(low.cast<int>() + up);
    if (value == 0.0)
    {
      continue;
    }
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= up[axis] == 1 ? part[axis] : 1.0 - part[axis];
    }
    sum += weight * value;
    known += weight;
  }
  constexpr double kCorner = 0.1; // half a step beyond three borders an eighth is known
  return known > kCorner ? sum / known : std::numeric_limits<double>::quiet_NaN();
}

} // namespace palp
