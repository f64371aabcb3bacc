#include "pipeline/health/open_sides.h"

#include <algorithm>
#include <map>
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

// the unpaired side that goes on where one ends, around the triangles of its end; none where they
// are turned against each other
std::optional<Side> nextSide(std::span<const Triangle> triangles, const Edges& edges, Side side)
{
  std::size_t k = after(at(side.k));
  const int end = triangles[at(side.triangle)][k];
  while (edges.across[at(side.triangle)][k] >= 0)
  {
    const int far = triangles[at(side.triangle)][after(k)];
    side.triangle = edges.across[at(side.triangle)][k];
    const Triangle& other = triangles[at(side.triangle)];
    k = cornerAt(other, end);
    if (other[after(after(k))] != far)
    {
      return std::nullopt;
    }
  }
  return Side{ side.triangle, static_cast<int>(k) };
}

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

std::vector<std::vector<Side>> borders(std::span<const Triangle> triangles, const Edges& edges)
{
  std::vector<std::array<bool, kSides>> met(triangles.size(), { false, false, false });
  std::vector<std::vector<Side>> result;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < kSides; ++k)
    {
      std::vector<Side> border;
      for (std::optional<Side> side{ { static_cast<int>(i), static_cast<int>(k) } };
           side && edges.across[at(side->triangle)][at(side->k)] < 0 &&
           !std::exchange(met[at(side->triangle)][at(side->k)], true);
           side = nextSide(triangles, edges, *side))
      {
        border.push_back(*side);
      }
      border.empty() ? void() : result.push_back(std::move(border));
    }
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
