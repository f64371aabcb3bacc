#include "pipeline/formats/regions/piece_volumes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
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

// Which way each point goes outward, of length 1, or 0 where its triangles are none.
std::vector<Eigen::Vector3d> outwardOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  std::vector<Eigen::Vector3d> outward(points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : triangles)
  {
    const Eigen::Vector3d vector = areaOf(points[at(a)], points[at(b)], points[at(c)]);
    for (const int corner : { a, b, c })
    {
      outward[at(corner)] += vector;
    }
  }
  std::ranges::for_each(outward, [](Eigen::Vector3d& way) { way.normalize(); });
  return outward;
}

// Moves each piece outward evenly until it has about its volume; false: it had.
bool swell(std::vector<Eigen::Vector3d>& points, std::span<const Eigen::Vector3d> outward,
  std::span<const Triangle> triangles, std::span<const int> pieces,
  std::span<const PieceSize> wanted)
{
  const std::vector<PieceSize> sizes = pieceSizes(points, triangles, pieces);
  constexpr double kEnough = 1e-6; // of the volume
  if (std::ranges::equal(sizes, wanted,
        [&](const PieceSize& is, const PieceSize& asked)
        { return std::abs(is.volume - asked.volume) <= kEnough * std::abs(asked.volume); }))
  {
    return false;
  }
  std::vector<double> move(points.size(), 0.0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const auto piece = at(pieces[i]);
    const double lack = (wanted[piece].volume - sizes[piece].volume) / sizes[piece].area;
    std::ranges::for_each(triangles[i], [&](int corner) { move[at(corner)] = lack; });
  }
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] += move[i] * outward[i];
  }
  return true;
}

// of each point: volume that it lost, and area
using Shares = std::vector<Eigen::Array2f>;

// Over the neighborhood, by a random walk. The sums are the same; waves shorter than some twenty
// edges, as of terraces, are gone.
Shares spread(const Neighbors& neighbors, const Shares& now)
{
  constexpr std::size_t kSteps = 19;
  constexpr float kSlow = 0.98F;       // what a step of the walk leaves of the waves that stay
  constexpr float kStay = -0.2F;       // from -1/2, as bendLeast tells, to -0.8, which is soon gone
  std::vector<float> part(now.size()); // that goes to each neighbor
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    part[i] = (1.0F - kStay) / static_cast<float>(neighbors.of(i).size());
  }
  std::array<Shares, 2> walk{ now, now }; // after even steps, and after odd ones
  std::array<Shares, 2> sent{ now, now }; // to each neighbor then
  std::array<float, kSteps> pace{ 1.0F };
  for (std::size_t step = 1; step < kSteps; ++step)
  {
    pace[step] = 1.0F / (1.0F - (step == 1 ? 0.5F : 0.25F * pace[step - 1]) * kSlow * kSlow);
  }
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    sent[0][i] *= part[i];
  }
  neighbors.inWaves(kSteps,
    [&](std::size_t step, std::size_t block)
    {
      const std::size_t even = step % 2;
      neighbors.each(block,
        [&](std::size_t i, auto around)
        {
          Eigen::Array2f sum = kStay * walk[even][i];
          for (const int neighbor : around)
          {
            sum += sent[even][at(neighbor)];
          }
          Eigen::Array2f& next = walk[1 - even][i]; // which is that before
          next += pace[step] * (sum - next);
          sent[1 - even][i] = part[i] * next;
        });
    });
  return walk[kSteps % 2];
}

// What the triangles at each point lost as they moved, and their area: a third of each. Simpson's
// rule is exact for the volume that a triangle sweeps.
Shares lost(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> now,
  std::span<const Triangle> triangles)
{
  Shares shares(now.size(), Eigen::Array2f::Zero());
  for (const auto& [a, b, c] : triangles)
  {
    const auto areaAt = [&, corners = std::array{ at(a), at(b), at(c) }](double part)
    {
      const auto point = [&](std::size_t i) -> Eigen::Vector3d
      { return from[i] + part * (now[i] - from[i]); };
      return areaOf(point(corners[0]), point(corners[1]), point(corners[2]));
    };
    const Eigen::Vector3d moved =
      now[at(a)] - from[at(a)] + now[at(b)] - from[at(b)] + now[at(c)] - from[at(c)];
    const Eigen::Vector3d end = areaAt(1.0);
    const double swept = moved.dot(areaAt(0.0) + 4.0 * areaAt(0.5) + end) / 18.0;
    const Eigen::Array2f third = (Eigen::Array2d(-swept, end.norm()) / 3.0).cast<float>();
    for (const int corner : { a, b, c })
    {
      shares[at(corner)] += third;
    }
  }
  return shares;
}

// moves each point outward by what its neighborhood lost
void swellLocally(std::vector<Eigen::Vector3d>& points, std::span<const Eigen::Vector3d> outward,
  std::span<const Eigen::Vector3d> from, std::span<const Triangle> triangles,
  const Neighbors& neighbors)
{
  const Shares shares = spread(neighbors, lost(from, points, triangles));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const auto& [volume, area] = std::pair<double, double>(shares[i][0], shares[i][1]);
    points[i] += area > 0.0 ? (volume / area * outward[i]).eval() : Eigen::Vector3d::Zero().eval();
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
  std::span<const Triangle> triangles, const Neighbors& neighbors,
  const std::function<void()>& bound, std::span<const int> pieces, std::span<const PieceSize> sizes)
{
  const std::vector<Eigen::Vector3d> outward = outwardOf(points, triangles); // also a little later
  constexpr int kLocally = 2;
  for (int i = 0; i < kLocally; ++i)
  {
    swellLocally(points, outward, from, triangles, neighbors);
    bound();
  }
  constexpr int kEvenly = 4;
  for (int i = 0; i < kEvenly && swell(points, outward, triangles, pieces, sizes); ++i)
  {
    bound();
  }
}

} // namespace palp
