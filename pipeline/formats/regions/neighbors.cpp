#include "pipeline/formats/regions/neighbors.h"

#include <algorithm>
#include <numeric>

namespace palp
{
namespace
{

constexpr std::size_t kBlock = 2048; // points

} // namespace

void groupByTriangles(std::vector<Eigen::Vector3d>& points, std::vector<Triangle>& triangles)
{
  std::vector<int> count(points.size(), 0);
  for (const Triangle& triangle : triangles)
  {
    std::ranges::for_each(triangle, [&](int corner) { ++count[at(corner)]; });
  }
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t first = 0; first < order.size(); first += kBlock)
  {
    const std::span block(order.data() + first, std::min(kBlock, order.size() - first));
    std::ranges::stable_sort(block, {}, [&](int point) { return count[at(point)]; });
  }
  std::vector<Eigen::Vector3d> moved(points.size());
  std::vector<int>& number = count; // which is used up
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    moved[i] = points[at(order[i])];
    number[at(order[i])] = static_cast<int>(i);
  }
  points = std::move(moved);
  for (Triangle& triangle : triangles)
  {
    std::ranges::for_each(triangle, [&](int& corner) { corner = number[at(corner)]; });
  }
}

Neighbors::Neighbors(std::size_t points, const Edges& edges)
  : first_(points + 1, 0)
  , all_(2 * edges.all.size())
{
  for (const auto& [a, b] : edges.all)
  {
    ++first_[at(a) + 1];
    ++first_[at(b) + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<int> next = first_;
  for (const auto& [a, b] : edges.all)
  {
    all_[at(next[at(a)]++)] = b;
    all_[at(next[at(b)]++)] = a;
  }
  for (std::size_t i = 0; i < points; ++i)
  {
    const bool isNewBlock = i % kBlock == 0;
    if (isNewBlock)
    {
      firstRun_.push_back(runs_.size());
      needed_.push_back(i > 0 ? needed_.back() : 0);
    }
    if (isNewBlock || of(i).size() != of(i - 1).size())
    {
      runs_.push_back(i);
    }
    const std::span<const int> around = of(i);
    const std::size_t last = around.empty() ? i : std::max(i, at(std::ranges::max(around)));
    needed_.back() = std::max(needed_.back(), last / kBlock);
  }
  firstRun_.push_back(runs_.size());
  runs_.push_back(points);
}

void Neighbors::inWaves(
  std::size_t steps, const std::function<void(std::size_t, std::size_t)>& work) const
{
  constexpr std::size_t kTogether = 40; // steps whose blocks fit that memory
  const std::size_t blocks = needed_.size();
  for (std::size_t begin = 0; begin < steps; begin += kTogether)
  {
    std::vector<std::size_t> done(std::min(kTogether, steps - begin), 0); // blocks of each step
    for (std::size_t block = 0; block < blocks; ++block)
    {
      work(begin, done[0]++);
      for (std::size_t i = 1; i < done.size(); ++i)
      {
        while (done[i] < blocks && needed_[done[i]] < done[i - 1])
        {
          work(begin + i, done[i]++);
        }
      }
    }
  }
}

} // namespace palp
