#include "pipeline/formats/regions/least_bending.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// four numbers, so that a point is one word of the processor; the last is 0
using Points = std::vector<Eigen::Array4f>;

// the mean of the neighbors less the point itself
inline Eigen::Array4f laplacian(const Neighbors& neighbors, const Points& points, std::size_t i)
{
  const std::span<const int> around = neighbors.of(i);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const int neighbor : around)
  {
    sum += points[at(neighbor)];
  }
  return sum / static_cast<float>(around.size()) - points[i];
}

} // namespace

void bendLeast(
  std::vector<Eigen::Vector3d>& points, const Neighbors& neighbors, const Eigen::Array3d& most)
{
  const std::size_t count = points.size();
  const Eigen::Vector3d origin = points.front(); // single precision is enough about it
  Points from(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    from[i] << (points[i] - origin).cast<float>().array(), 0.0F;
  }
  Eigen::Array4f reach;
  reach << most.cast<float>(), 0.0F;
  Points now = from;
  Points ahead = from;
  Points bend(count);
  constexpr std::size_t kWork = 300'000'000; // steps of a point, for some seconds at most
  const std::size_t steps = std::clamp<std::size_t>(kWork / count, 10, 100);
  constexpr float kStep = 0.25F; // the inverse of the largest value of the Laplacian, squared
  float pace = 1.0F;
  for (std::size_t step = 0; step < steps; ++step)
  {
    const float faster = 0.5F * (1.0F + std::sqrt(1.0F + 4.0F * pace * pace));
    const float momentum = (pace - 1.0F) / faster;
    pace = faster;
    for (std::size_t i = 0; i < count; ++i)
    {
      bend[i] = laplacian(neighbors, ahead, i);
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const Eigen::Array4f slope = laplacian(neighbors, bend, i);
      const Eigen::Array4f next =
        (ahead[i] - kStep * slope).max(from[i] - reach).min(from[i] + reach);
      ahead[i] = next + momentum * (next - now[i]);
      now[i] = next;
    }
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = origin + now[i].head<3>().cast<double>().matrix();
  }
}

} // namespace palp
