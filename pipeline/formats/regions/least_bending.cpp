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
template <std::size_t kCount>
Eigen::Array4f laplacian(std::span<const int, kCount> around, const Points& points, std::size_t i)
{
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (const int neighbor : around)
  {
    sum += points[at(neighbor)];
  }
  return (1.0F / static_cast<float>(around.size())) * sum - points[i];
}

// of each step, how much of its way a point goes on
std::vector<float> momenta(std::size_t steps)
{
  std::vector<float> all;
  float pace = 1.0F;
  for (std::size_t step = 0; step < steps; ++step)
  {
    const float faster = 0.5F * (1.0F + std::sqrt(1.0F + 4.0F * pace * pace));
    all.push_back((pace - 1.0F) / faster);
    pace = faster;
  }
  return all;
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
  constexpr std::size_t kWork = 225'000'000; // steps of a point, for some seconds at most
  const std::vector<float> momentum = momenta(std::clamp<std::size_t>(kWork / count, 8, 75));
  // The inverse of the Laplacian's largest eigenvalue, squared: as each edge is one of two
  // triangles, and no (a + b + c)^2 of their corners is negative, it is 3/2.
  constexpr float kStep = 4.0F / 9.0F;
  const auto slide = [&](std::size_t half, std::size_t block) // half a step
  {
    half % 2 == 0 ? neighbors.each(block,
                      [&](std::size_t i, auto around) { bend[i] = laplacian(around, ahead, i); })
                  : neighbors.each(block,
                      [&, onward = momentum[half / 2]](std::size_t i, auto around)
                      {
                        const Eigen::Array4f slope = laplacian(around, bend, i);
                        const Eigen::Array4f next =
                          (ahead[i] - kStep * slope).max(from[i] - reach).min(from[i] + reach);
                        ahead[i] = next + onward * (next - now[i]);
                        now[i] = next;
                      });
  };
  neighbors.inWaves(2 * momentum.size(), slide);
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = origin + now[i].head<3>().cast<double>().matrix();
  }
}

} // namespace palp
