#include "pipeline/health/t_junctions.h"

#include "haptics/surface/edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>

namespace palp
{
namespace
{

constexpr double kOn = 1e-3; // [-] of an edge

// what is open of a surface, in order along its longest way
class OpenPoints
{
public:
  OpenPoints(std::span<const Eigen::Vector3d> points, const std::vector<std::array<int, 2>>& edges)
    : points_(points)
  {
    Eigen::AlignedBox3d box;
    for (const std::array<int, 2>& edge : edges)
    {
      for (const int end : edge)
      {
        open_.push_back(end);
        box.extend(points[at(end)]);
      }
    }
    if (!box.isEmpty())
    {
      box.sizes().maxCoeff(&along_);
    }
    const auto place = [this](int i) { return std::pair(points_[at(i)][along_], i); };
    std::ranges::sort(open_, {}, place);
    open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
  }

  // those within an edge, from a to b
  [[nodiscard]] std::vector<int> on(int a, int b) const
  {
    const Eigen::Vector3d from = points_[at(a)];
    const Eigen::Vector3d way = points_[at(b)] - from;
    const double length = way.norm();
    const auto [low, high] = std::minmax(from[along_], points_[at(b)][along_]);
    const auto place = [this](int i) { return points_[at(i)][along_]; };
    std::vector<std::pair<double, int>> found;
    for (auto i = std::ranges::lower_bound(open_, low - kOn * length, {}, place);
         i != open_.end() && place(*i) <= high + kOn * length; ++i)
    {
      const Eigen::Vector3d to = points_[at(*i)] - from;
      const double share = to.dot(way) / (length * length);
      const bool isWithin = share > kOn && share < 1.0 - kOn && *i != a && *i != b;
      if (isWithin && (to - share * way).norm() <= kOn * length)
      {
        found.emplace_back(share, *i);
      }
    }
    std::ranges::sort(found);
    std::vector<int> result(found.size());
    std::ranges::transform(found, result.begin(), &std::pair<double, int>::second);
    return result;
  }

private:
  std::span<const Eigen::Vector3d> points_;
  std::vector<int> open_;
  Eigen::Index along_ = 0;
};

using Chain = std::vector<int>; // from one end of an open edge over points on it to the other
using Chains = std::map<std::array<int, 2>, Chain>;

// Leaves alone the edges of which a part would stay open: each part belongs to a second one, too.
void keepMatched(Chains& chains)
{
  const auto partOf = [](const Chain& chain, std::size_t i) {
    return std::array{ std::min(chain[i], chain[i + 1]), std::max(chain[i], chain[i + 1]) };
  };
  for (bool isStable = false; !isStable;)
  {
    std::map<std::array<int, 2>, int> often;
    for (const auto& [edge, chain] : chains)
    {
      for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      {
        ++often[partOf(chain, i)];
      }
    }
    isStable = true;
    for (auto& [edge, chain] : chains)
    {
      bool isOpen = false;
      for (std::size_t i = 0; i + 1 < chain.size(); ++i)
      {
        isOpen = isOpen || often[partOf(chain, i)] < 2;
      }
      if (isOpen && chain.size() > 2)
      {
        chain = { chain.front(), chain.back() };
        isStable = false;
      }
    }
  }
}

// cuts a triangle at the points of its side k, from the corner behind that; the rest is added
void cut(std::vector<Triangle>& triangles, std::size_t triangle, std::size_t k, const Chain& chain)
{
  const int apex = triangles[triangle][(k + 2) % 3];
  triangles[triangle] = { chain[0], chain[1], apex };
  for (std::size_t i = 1; i + 1 < chain.size(); ++i)
  {
    triangles.push_back({ chain[i], chain[i + 1], apex });
  }
}

} // namespace

std::size_t cutAtTJunctions(
  std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles)
{
  const std::size_t before = triangles.size();
  const Edges edges = edgesOf(points.size(), triangles);
  const OpenPoints open(points, edges.unpaired);
  Chains chains;
  for (const auto& [a, b] : edges.unpaired)
  {
    Chain chain = open.on(a, b);
    chain.insert(chain.begin(), a);
    chain.push_back(b);
    chains.emplace(std::array{ a, b }, std::move(chain));
  }
  keepMatched(chains);
  for (std::size_t i = 0; i < triangles.size(); ++i) // those that are added, too
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const int from = triangles[i][k];
      const int to = triangles[i][(k + 1) % 3];
      const auto found = chains.find({ std::min(from, to), std::max(from, to) });
      if (found == chains.end() || found->second.size() == 2 ||
        std::ranges::count(found->second, triangles[i][(k + 2) % 3]) > 0)
      {
        continue;
      }
      Chain chain = found->second;
      from == chain.front() ? void() : void(std::ranges::reverse(chain));
      cut(triangles, i, k, chain);
    }
  }
  return triangles.size() - before;
}

} // namespace palp
