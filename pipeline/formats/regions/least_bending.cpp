#include "pipeline/formats/regions/least_bending.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

// four numbers, so that a point is one word of the processor; the last is 0
using Points = std::vector<Eigen::Array4f>;

// the neighbors of all points, one after the other
struct Neighbors
{
  std::vector<int> first; // #points + 1
  std::vector<int> all;
};

Neighbors neighborsOf(std::size_t points, const Edges& edges)
{
  Neighbors result{ .first = std::vector<int>(points + 1, 0), .all = {} };
  for (const auto& [a, b] : edges.all)
  {
    ++result.first[at(a) + 1];
    ++result.first[at(b) + 1];
  }
  for (std::size_t i = 0; i < points; ++i)
  {
    result.first[i + 1] += result.first[i];
  }
  result.all.resize(2 * edges.all.size());
  std::vector<int> next = result.first;
  for (const auto& [a, b] : edges.all)
  {
    result.all[at(next[at(a)]++)] = b;
    result.all[at(next[at(b)]++)] = a;
  }
  return result;
}

// the mean of the neighbors less the point itself
Eigen::Array4f laplacian(const Neighbors& neighbors, const Points& points, std::size_t i)
{
  const auto first = at(neighbors.first[i]);
  const auto end = at(neighbors.first[i + 1]);
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (std::size_t k = first; k < end; ++k)
  {
    sum += points[at(neighbors.all[k])];
  }
  return sum / static_cast<float>(end - first) - points[i];
}

Eigen::Vector3d areaOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return 0.5 * (b - a).cross(c - a);
}

// moves each piece outward evenly until it has about its volume
void swell(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles,
  std::span<const int> pieces, std::span<const PieceSize> wanted)
{
  const std::vector<PieceSize> sizes = pieceSizes(points, triangles, pieces);
  std::vector<Eigen::Vector3d> outward(points.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3d> move = outward;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const auto piece = at(pieces[i]);
    const auto& [a, b, c] = triangles[i];
    const Eigen::Vector3d vector = areaOf(points[at(a)], points[at(b)], points[at(c)]);
    const double lack = (wanted[piece].volume - sizes[piece].volume) / sizes[piece].area;
    for (const int corner : triangles[i])
    {
      outward[at(corner)] += vector;
      move[at(corner)] += lack * vector;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double size = outward[i].norm();
    points[i] += size > 0.0 ? (move[i] / size).eval() : Eigen::Vector3d::Zero().eval();
  }
}

} // namespace

std::vector<PieceSize> pieceSizes(std::span<const Eigen::Vector3d> points,
  std::span<const Triangle> triangles, std::span<const int> pieces)
{
  std::vector<PieceSize> sizes(static_cast<std::size_t>(std::ranges::max(pieces)) + 1);
  const Eigen::Vector3d& from = points.front();
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const auto& [a, b, c] = triangles[i];
    const Eigen::Vector3d vector = areaOf(points[at(a)], points[at(b)], points[at(c)]);
    sizes[at(pieces[i])].volume += (points[at(a)] - from).dot(vector) / 3.0;
    sizes[at(pieces[i])].area += vector.norm();
  }
  return sizes;
}

void bendLeast(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles,
  const Edges& edges, const Eigen::Array3d& most, std::span<const int> pieces,
  std::span<const PieceSize> sizes)
{
  const std::size_t count = points.size();
  const Neighbors neighbors = neighborsOf(count, edges);
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
  const std::vector<Eigen::Vector3d> before = points;
  for (std::size_t i = 0; i < count; ++i)
  {
    points[i] = origin + now[i].head<3>().cast<double>().matrix();
  }
  for (int i = 0; i < 4; ++i) // the bounds take some of it back
  {
    swell(points, triangles, pieces, sizes);
    for (std::size_t k = 0; k < count; ++k)
    {
      points[k] =
        points[k].array().max(before[k].array() - most).min(before[k].array() + most).matrix();
    }
  }
}

} // namespace palp
