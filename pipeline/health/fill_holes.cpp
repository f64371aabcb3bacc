#include "pipeline/health/fill_holes.h"

#include "haptics/surface/crossing.h"
#include "haptics/surface/edges.h"
#include "pipeline/health/open_sides.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

namespace palp
{
namespace
{

constexpr std::size_t kMostEdges = 500;

// the points around a border, against the way in which its triangles go
std::vector<int> chainOf(std::span<const Triangle> triangles, const std::vector<Side>& border)
{
  std::vector<int> chain;
  chain.reserve(border.size());
  for (const auto& [triangle, k] : border)
  {
    chain.push_back(triangles[at(triangle)][at(k)]);
  }
  std::ranges::reverse(chain);
  return chain;
}

// the edges within a filling, each once
std::vector<std::array<int, 2>> innerEdges(
  const std::vector<Triangle>& filling, const std::vector<int>& chain)
{
  std::vector<std::array<int, 2>> all =
    palp::edgesOf(static_cast<std::size_t>(std::ranges::max(chain)) + 1, filling).all;
  for (std::size_t i = 0; i < chain.size(); ++i)
  {
    const auto [low, high] = std::minmax(chain[i], chain[(i + 1) % chain.size()]);
    std::erase(all, std::array{ low, high });
  }
  return all;
}

// goes around once and ends where it began
bool isClosed(std::span<const Triangle> triangles, const std::vector<Side>& border)
{
  const auto& [triangle, k] = border.back();
  const auto& [firstTriangle, firstK] = border.front();
  return border.size() >= 3 &&
    triangles[at(triangle)][(at(k) + 1) % 3] == triangles[at(firstTriangle)][at(firstK)];
}

// drops what passes through the surface, or through another filling
void dropCrossing(std::span<const Eigen::Vector3d> points, const std::vector<Triangle>& triangles,
  std::vector<std::vector<Triangle>>& fillings)
{
  std::vector<Triangle> all = triangles;
  std::vector<std::size_t> fillingOf; // of each that is added
  for (std::size_t i = 0; i < fillings.size(); ++i)
  {
    all.insert(all.end(), fillings[i].begin(), fillings[i].end());
    fillingOf.resize(all.size() - triangles.size(), i);
  }
  if (fillingOf.empty())
  {
    return;
  }
  for (const int triangle : crossingTriangles(BoxTree(points, all), all))
  {
    at(triangle) < triangles.size() ? void()
                                    : fillings[fillingOf[at(triangle) - triangles.size()]].clear();
  }
  std::erase_if(fillings, [](const std::vector<Triangle>& filling) { return filling.empty(); });
}

} // namespace

double lengthAround(std::span<const Eigen::Vector3d> points, std::span<const int> chain)
{
  double length = 0.0;
  for (std::size_t i = 0; i < chain.size(); ++i)
  {
    length += (points[at(chain[(i + 1) % chain.size()])] - points[at(chain[i])]).norm();
  }
  return length;
}

std::vector<Triangle> smallestFilling(std::span<const Eigen::Vector3d> points,
  std::span<const int> chain, const std::set<std::array<int, 2>>& known)
{
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const std::size_t n = chain.size();
  // of the part of the chain from i to j, closed by the line between them
  std::vector<double> least(n * n, 0.0);
  std::vector<std::size_t> apex(n * n, 0);
  const auto isKnown = [&](std::size_t i, std::size_t j)
  {
    const auto [low, high] = std::minmax(chain[i], chain[j]);
    return j - i + 1 < n && (low == high || known.contains({ low, high }));
  };
  const auto position = [&](std::size_t i) -> const Eigen::Vector3d&
  { return points[at(chain[i])]; };
  for (std::size_t length = 2; length < n; ++length)
  {
    for (std::size_t i = 0, j = length; j < n; ++i, ++j)
    {
      least[i * n + j] = kNone;
      const std::size_t end = isKnown(i, j) ? i : j;
      for (std::size_t k = i + 1; k < end; ++k)
      {
        const double area = (position(k) - position(i)).cross(position(j) - position(i)).norm();
        if (const double sum = least[i * n + k] + area + least[k * n + j]; sum < least[i * n + j])
        {
          least[i * n + j] = sum;
          apex[i * n + j] = k;
        }
      }
    }
  }
  std::vector<Triangle> result;
  std::vector<std::pair<std::size_t, std::size_t>> parts;
  least[n - 1] < kNone ? parts.push_back({ 0, n - 1 }) : void();
  while (!parts.empty())
  {
    const auto [i, j] = parts.back();
    parts.pop_back();
    if (j - i >= 2)
    {
      const std::size_t k = apex[i * n + j];
      result.push_back({ chain[i], chain[k], chain[j] });
      parts.insert(parts.end(), { { i, k }, { k, j } });
    }
  }
  return result;
}

FilledHoles fillHoles(
  std::span<const Eigen::Vector3d> points, std::vector<Triangle>& triangles, double longest)
{
  const Edges edges = edgesOf(points.size(), triangles);
  const std::vector<std::vector<Side>> holes = borders(points, triangles, edges);
  // with one of these a filling would lie on the surface, or not be a manifold with it
  std::set<std::array<int, 2>> known(edges.all.begin(), edges.all.end());
  std::vector<std::vector<Triangle>> fillings;
  std::size_t unfit = 0;
  for (const std::vector<Side>& border : holes)
  {
    const std::vector<int> chain = chainOf(triangles, border);
    const bool isTriangle = std::ranges::all_of(
      border, [&](const Side& side) { return side.triangle == border.front().triangle; });
    if (isTriangle || !isClosed(triangles, border) || lengthAround(points, chain) > longest)
    {
      continue;
    }
    std::vector<Triangle> filling =
      chain.size() > kMostEdges ? std::vector<Triangle>() : smallestFilling(points, chain, known);
    if (filling.empty())
    {
      ++unfit;
      continue;
    }
    const std::vector<std::array<int, 2>> inner = innerEdges(filling, chain);
    known.insert(inner.begin(), inner.end());
    fillings.push_back(std::move(filling));
  }
  const std::size_t all = fillings.size();
  dropCrossing(points, triangles, fillings);
  for (const std::vector<Triangle>& filling : fillings)
  {
    triangles.insert(triangles.end(), filling.begin(), filling.end());
  }
  return { fillings.size(), all - fillings.size(), unfit };
}

} // namespace palp
