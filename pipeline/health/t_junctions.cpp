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
    open_.erase(std::ranges::unique(open_).begin(), open_.end());
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

// cuts a triangle at the points of its side k, from the corner behind that; the rest is added
void cut(std::vector<Triangle>& triangles, std::size_t triangle, std::size_t k,
  const std::vector<int>& between)
{
  const Triangle whole = triangles[triangle];
  const int apex = whole[(k + 2) % 3];
  triangles[triangle] = { whole[k], between.front(), apex };
  for (std::size_t i = 0; i < between.size(); ++i)
  {
    const int next = i + 1 < between.size() ? between[i + 1] : whole[(k + 1) % 3];
    triangles.push_back({ between[i], next, apex });
  }
}

} // namespace

std::size_t cutAtTJunctions(
  std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles)
{
  const std::size_t before = triangles.size();
  const Edges edges = edgesOf(points.size(), triangles);
  const OpenPoints open(points, edges.unpaired);
  std::map<std::array<int, 2>, std::vector<int>> onEdge;
  for (const auto& [a, b] : edges.unpaired)
  {
    std::vector<int> found = open.on(a, b);
    onEdge.try_emplace({ b, a }, found.rbegin(), found.rend());
    onEdge.try_emplace({ a, b }, std::move(found));
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) // those that are added, too
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto found = onEdge.find({ triangles[i][k], triangles[i][(k + 1) % 3] });
      if (found != onEdge.end() && !found->second.empty() &&
        std::ranges::count(found->second, triangles[i][(k + 2) % 3]) == 0)
      {
        cut(triangles, i, k, found->second);
      }
    }
  }
  return triangles.size() - before;
}

} // namespace palp
