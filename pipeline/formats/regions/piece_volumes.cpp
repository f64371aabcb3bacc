#include "pipeline/formats/regions/piece_volumes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace palp
{
namespace
{

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

// of a point: volume that it lost, and area
using Shares = std::vector<Eigen::Array2f>;

// One step of a random walk from each point to those next to it, or to itself, so that it has no
// waves of two edges. The sums stay.
void walk(const Neighbors& neighbors, const Shares& now, Shares& parts, Shares& next)
{
  constexpr float kStay = 0.25F;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    parts[i] = (1.0F - kStay) / static_cast<float>(neighbors.of(i).size()) * now[i];
  }
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    next[i] = kStay * now[i];
    for (const int neighbor : neighbors.of(i))
    {
      next[i] += parts[at(neighbor)];
    }
  }
}

// over the neighborhood: waves shorter than some twenty edges, as of terraces, are gone
Shares spread(const Neighbors& neighbors, Shares before)
{
  constexpr int kSteps = 24;
  constexpr float kSlow = 0.98F; // what each step of a walk leaves of the waves that stay
  Shares parts(before.size());
  Shares now(before.size());
  Shares next(before.size());
  walk(neighbors, before, parts, now);
  float pace = 2.0F;
  for (int step = 1; step < kSteps; ++step)
  {
    pace = 1.0F / (1.0F - 0.25F * kSlow * kSlow * pace);
    walk(neighbors, now, parts, next);
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      next[i] = pace * (next[i] - before[i]) + before[i];
    }
    before.swap(now);
    now.swap(next);
  }
  return now;
}

// what the triangles at each point lost as they moved, and their area: a third of each
Shares lost(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> now,
  std::span<const Triangle> triangles)
{
  Shares shares(now.size(), Eigen::Array2f::Zero());
  for (const auto& [a, b, c] : triangles)
  {
    const auto areaAt = [&](double part)
    {
      const auto point = [&](int i) -> Eigen::Vector3d
      { return from[at(i)] + part * (now[at(i)] - from[at(i)]); };
      return areaOf(point(a), point(b), point(c));
    };
    const Eigen::Vector3d moved =
      now[at(a)] - from[at(a)] + now[at(b)] - from[at(b)] + now[at(c)] - from[at(c)];
    const Eigen::Vector3d end = areaAt(1.0);
    const double swept = moved.dot(areaAt(0.0) + 4.0 * areaAt(0.5) + end) / 18.0; // Simpson
    const Eigen::Array2f third = Eigen::Array2d(-swept / 3.0, end.norm() / 3.0).cast<float>();
    for (const int corner : { a, b, c })
    {
      shares[at(corner)] += third;
    }
  }
  return shares;
}

// moves each point outward by what its neighborhood lost
void swellLocally(std::vector<Eigen::Vector3d>& points, std::span<const Eigen::Vector3d> from,
  std::span<const Triangle> triangles, const Neighbors& neighbors)
{
  const Shares shares = spread(neighbors, lost(from, points, triangles));
  std::vector<Eigen::Vector3d> outward(points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d vector = areaOf(points[at(a)], points[at(b)], points[at(c)]);
    for (const int corner : { a, b, c })
    {
      outward[at(corner)] += vector;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto& [volume, area] = std::pair<double, double>(shares[i][0], shares[i][1]);
    points[i] += area > 0.0 ? (volume / area * outward[i].normalized()).eval()
                            : Eigen::Vector3d::Zero().eval();
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

void restoreVolumes(std::vector<Eigen::Vector3d>& points, std::span<const Eigen::Vector3d> from,
  std::span<const Triangle> triangles, const Neighbors& neighbors, const Eigen::Array3d& most,
  std::span<const int> pieces, std::span<const PieceSize> sizes)
{
  const auto bound = [&] // which takes some of it back
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      points[i] =
        points[i].array().max(from[i].array() - most).min(from[i].array() + most).matrix();
    }
  };
  constexpr int kLocally = 3;
  for (int i = 0; i < kLocally; ++i)
  {
    swellLocally(points, from, triangles, neighbors);
    bound();
  }
  constexpr int kEvenly = 4;
  for (int i = 0; i < kEvenly; ++i)
  {
    swell(points, triangles, pieces, sizes);
    bound();
  }
}

} // namespace palp
