#include "haptics/surface/sampling/deviation.h"

#include "haptics/surface/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <future>
#include <utility>

namespace palp
{
namespace
{

std::vector<Eigen::Vector3d> usedPoints(const Surface& surface)
{
  std::vector<Eigen::Vector3d> used;
  for (std::size_t i = 0; i < surface.points().size(); ++i)
  {
    if (surface.firstTriangle(static_cast<int>(i)) >= 0)
    {
      used.push_back(surface.points()[i]);
    }
  }
  return used;
}

// Of points to triangles: the largest, and the sum of the squares, or until one is more than most.
// pairs: places on them, near the points
std::pair<double, double> distances(std::span<const Eigen::Vector3d> from, const BoxTree& to,
  double most, std::span<const Eigen::Vector3d> pairs)
{
  constexpr std::size_t kMany = 1 << 16; // points tell the mean of all to some thousandths
  const std::size_t oneOf = 1 + from.size() / kMany;
  // by the golden ratio, so that whatever order points have in memory, they are evenly chosen
  constexpr std::uint32_t kTurn = 2'654'435'769;
  const auto part = static_cast<std::uint32_t>(std::numeric_limits<std::uint32_t>::max() / oneOf);
  const auto isChosen = [part](std::size_t i)
  { return static_cast<std::uint32_t>(i) * kTurn <= part; };
  constexpr double kAbove = 1.0 + 1e-9; // rounding
  double largest = 0.0;
  double sum = 0.0;
  double summed = 0.0;
  for (std::size_t i = 0; i < from.size() && largest <= most; ++i)
  {
    const double reach = i < pairs.size() ? kAbove * (pairs[i] - from[i]).norm()
                                          : std::numeric_limits<double>::infinity();
    if (isChosen(i))
    {
      const double distance = distanceTo(to, from[i], reach);
      largest = std::max(largest, distance);
      sum += distance * distance;
      summed += 1.0;
    }
    else if (reach > largest)
    {
      largest = std::max(largest, distanceTo(to, from[i], reach, largest));
    }
  }
  return { largest, summed > 0.0 ? sum / summed * static_cast<double>(from.size()) : 0.0 };
}

} // namespace

Deviation deviation(const Surface& a, const Surface& b)
{
  return deviation(usedPoints(a), a.tree(), usedPoints(b), b.tree());
}

Deviation deviation(std::span<const Eigen::Vector3d> a, const BoxTree& aTree,
  std::span<const Eigen::Vector3d> b, const BoxTree& bTree, const DeviationSearch& search)
{
  const auto begin = [&](std::span<const Eigen::Vector3d> from, const BoxTree& to,
                       std::span<const Eigen::Vector3d> pairs)
  {
    return std::async(search.threads, distances, from, std::cref(to), search.most,
      search.paired ? pairs : std::span<const Eigen::Vector3d>());
  };
  const std::size_t half = b.size() / 2; // b may have many more points than a
  const std::size_t pairs = std::min(half, a.size());
  std::array parts{ begin(b.first(half), aTree, a.first(pairs)),
    begin(b.subspan(half), aTree, a.subspan(pairs)), begin(a, bTree, b) };
  double largest = 0.0;
  double sum = 0.0;
  for (auto& part : parts)
  {
    const auto [partLargest, partSum] = part.get();
    largest = std::max(largest, partLargest);
    sum += partSum;
  }
  return { .largest = largest,
    .rootMeanSquare = std::sqrt(sum / static_cast<double>(a.size() + b.size())) };
}

} // namespace palp
