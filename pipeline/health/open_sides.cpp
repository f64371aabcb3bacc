#include "pipeline/health/open_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kSides = 3;

std::size_t after(std::size_t k)
{
  return (k + 1) % kSides;
}

// where a triangle has a point
std::size_t cornerAt(const Triangle& triangle, int point)
{
  return static_cast<std::size_t>(std::ranges::find(triangle, point) - triangle.begin());
}

// sides at open edges, until they are taken into a chain
class OpenWays
{
public:
  OpenWays(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles,
    const Edges& edges)
    : points_(points)
    , triangles_(triangles)
    , from_(points.size())
    , normals_(points.size(), Eigen::Vector3d::Zero())
  {
    for (const std::vector<Side>& sides : unpairedSides(triangles, edges))
    {
      sides.size() == 1 ? from_[at(start(sides.front()))].push_back(sides.front()) : void();
    }
    for (const auto& [a, b, c] : triangles)
    {
      const Eigen::Vector3d area =
        (points[at(b)] - points[at(a)]).cross(points[at(c)] - points[at(a)]);
      for (const int corner : { a, b, c })
      {
        normals_[at(corner)] += area;
      }
    }
  }

  [[nodiscard]] int start(const Side& side) const
  {
    return triangles_[at(side.triangle)][at(side.k)];
  }

  // where chains begin: first those that nothing leads to, which would else be cut in two
  [[nodiscard]] std::vector<int> starts() const
  {
    std::vector<int> starts;
    std::vector<int> more(points_.size()); // that go off than come
    for (const std::vector<Side>& sides : from_)
    {
      for (const Side& side : sides)
      {
        starts.push_back(start(side));
        ++more[at(start(side))];
        --more[at(end(side))];
      }
    }
    std::stable_partition(
      starts.begin(), starts.end(), [&](int point) { return more[at(point)] > 0; });
    return starts;
  }

  // any one from a point
  std::optional<Side> take(int point)
  {
    return taken(from_[at(point)], from_[at(point)].begin());
  }

  // the one that goes on where one ends, around the hole: the first, turned from that about its end
  std::optional<Side> takeAfter(const Side& side)
  {
    const int point = end(side);
    const Eigen::Vector3d back = points_[at(start(side))] - points_[at(point)];
    const Eigen::Vector3d normal = normals_[at(point)].normalized();
    const auto turn = [&](const Side& next)
    {
      const Eigen::Vector3d way = points_[at(end(next))] - points_[at(point)];
      const double angle =
        std::atan2(normal.dot(back.cross(way)), back.dot(way) - normal.dot(back) * normal.dot(way));
      return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
    };
    std::vector<Side>& ways = from_[at(point)];
    return taken(ways, std::ranges::min_element(ways, {}, turn));
  }

private:
  [[nodiscard]] int end(const Side& side) const
  {
    return triangles_[at(side.triangle)][after(at(side.k))];
  }

  static std::optional<Side> taken(std::vector<Side>& ways, std::vector<Side>::iterator way)
  {
    if (way == ways.end())
    {
      return std::nullopt;
    }
    const Side side = *way;
    ways.erase(way);
    return side;
  }

  std::span<const Eigen::Vector3d> points_;
  std::span<const Triangle> triangles_;
  std::vector<std::vector<Side>> from_; // each point
  std::vector<Eigen::Vector3d> normals_;
};

int rootOf(std::vector<int>& parents, int one)
{
  while (parents[at(one)] != one)
  {
    one = parents[at(one)] = parents[at(parents[at(one)])];
  }
  return one;
}

} // namespace

std::vector<std::vector<Side>> unpairedSides(
  std::span<const Triangle> triangles, const Edges& edges)
{
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < kSides; ++k)
    {
      if (edges.across[i][k] < 0)
      {
        sides[std::minmax(triangles[i][k], triangles[i][after(k)])].push_back(
          { static_cast<int>(i), static_cast<int>(k) });
      }
    }
  }
  std::vector<std::vector<Side>> result;
  result.reserve(sides.size());
  for (auto& [edge, all] : sides)
  {
    result.push_back(std::move(all));
  }
  return result;
}

std::vector<std::vector<Side>> borders(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles, const Edges& edges)
{
  OpenWays ways(points, triangles, edges);
  std::vector<std::vector<Side>> result;
  std::vector<std::size_t> numbers(points.size()); // in the chain, from 1 on
  for (const int point : ways.starts())
  {
    std::vector<Side> chain;
    const auto cutFrom = [&](std::size_t first)
    {
      result.emplace_back(chain.begin() + static_cast<std::ptrdiff_t>(first), chain.end());
      chain.resize(first);
      for (const Side& side : result.back())
      {
        numbers[at(ways.start(side))] = 0;
      }
    };
    for (std::optional<Side> side = ways.take(point); side; side = ways.takeAfter(*side))
    {
      const std::size_t number = numbers[at(ways.start(*side))];
      number > 0 ? cutFrom(number - 1) : void(); // one hole is around
      chain.push_back(*side);
      numbers[at(ways.start(*side))] = chain.size();
    }
    chain.empty() ? void() : cutFrom(0);
  }
  return result;
}

std::vector<std::array<int, 3>> fansOf(std::span<const Triangle> triangles, const Edges& edges)
{
  std::vector<int> parents(kSides * triangles.size());
  std::iota(parents.begin(), parents.end(), 0);
  const auto corner = [](std::size_t triangle, std::size_t k)
  { return static_cast<int>(kSides * triangle + k); };
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < kSides; ++k)
    {
      const int other = edges.across[i][k];
      for (const std::size_t end : { k, after(k) })
      {
        if (other >= 0)
        {
          const std::size_t there = cornerAt(triangles[at(other)], triangles[i][end]);
          parents[at(rootOf(parents, corner(i, end)))] = rootOf(parents, corner(at(other), there));
        }
      }
    }
  }
  std::vector<std::array<int, 3>> fans(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < kSides; ++k)
    {
      fans[i][k] = rootOf(parents, corner(i, k));
    }
  }
  return fans;
}

} // namespace palp
