#include "pipeline/health/weld_seams.h"

#include "haptics/surface/edges.h"
#include "pipeline/health/open_sides.h"
#include "pipeline/model/merged_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <utility>

namespace palp
{
namespace
{

// how far each point may move to another [m]; 0: not at all
struct Reach
{
  std::vector<double> most;
  std::vector<bool> isOpen; // at an open edge
};

// closed: whether what is at no open edge moves, too, as a closed piece where others are open
Reach reachOf(
  std::span<const Eigen::Vector3d> points, const Edges& edges, double ofEdge, bool closed)
{
  Reach reach{ .most = std::vector<double>(points.size()),
    .isOpen = std::vector<bool>(points.size()) };
  for (const auto& [a, b] : edges.unpaired)
  {
    reach.isOpen[at(a)] = true;
    reach.isOpen[at(b)] = true;
  }
  const auto shorten = [&](const std::vector<std::array<int, 2>>& all, bool isOpen)
  {
    for (const auto& [a, b] : all)
    {
      const double most = ofEdge * (points[at(a)] - points[at(b)]).norm();
      for (const int end : { a, b })
      {
        double& of = reach.most[at(end)];
        of = reach.isOpen[at(end)] != isOpen ? of : of > 0.0 ? std::min(of, most) : most;
      }
    }
  };
  shorten(edges.unpaired, true);
  closed ? shorten(edges.all, false) : void();
  return reach;
}

// the point to which each goes: itself, or another, where one of the two is at an open edge
std::vector<int> nearOnes(std::span<const Eigen::Vector3d> points, const Reach& reach)
{
  std::vector<int> onto(points.size());
  std::iota(onto.begin(), onto.end(), 0);
  Eigen::AlignedBox3d box; // of what is open
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    reach.isOpen[i] ? void(box.extend(points[i])) : void();
  }
  if (box.isEmpty())
  {
    return onto;
  }
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    reach.most[i] > 0.0 && box.exteriorDistance(points[i]) <= reach.most[i] ? all.push_back(i)
                                                                            : void();
  }
  Eigen::Index along = 0;
  box.sizes().maxCoeff(&along);
  std::ranges::sort(all, {}, [&](std::size_t i) { return points[i][along]; });
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const std::size_t one = all[i];
    for (std::size_t k = i + 1; k < all.size() && at(onto[one]) == one; ++k)
    {
      const std::size_t other = all[k];
      if (points[other][along] - points[one][along] > reach.most[one])
      {
        break;
      }
      const double near = std::min(reach.most[one], reach.most[other]);
      if ((reach.isOpen[one] || reach.isOpen[other]) && at(onto[other]) == other &&
        (points[other] - points[one]).norm() <= near)
      {
        onto[other] = static_cast<int>(one);
      }
    }
  }
  return onto;
}

// edges that have not two triangles, where none is there twice
struct Unpaired
{
  std::size_t open = 0;
  std::size_t between = 0; // of them, those within points that were brought together
  std::size_t crowded = 0;
};

Unpaired unpairedOf(std::span<const Triangle> triangles, const std::vector<int>& onto)
{
  std::vector<bool> isShared(onto.size());
  for (std::size_t i = 0; i < onto.size(); ++i)
  {
    isShared[at(onto[i])] = isShared[at(onto[i])] || at(onto[i]) != i;
  }
  std::vector<Triangle> sewn(triangles.begin(), triangles.end());
  for (Triangle& triangle : sewn)
  {
    std::ranges::transform(triangle, triangle.begin(), [&](int i) { return onto[at(i)]; });
  }
  const std::vector<bool> repeated = repeatedTriangles(sewn);
  std::size_t i = 0;
  std::erase_if(sewn, [&](const Triangle&) { return repeated[i++]; });
  Unpaired result;
  for (const std::vector<Side>& sides : unpairedSides(sewn, edgesOf(onto.size(), sewn)))
  {
    const Triangle& one = sewn[at(sides.front().triangle)];
    const auto k = at(sides.front().k);
    const bool isOpen = sides.size() == 1;
    result.open += isOpen ? 1U : 0U;
    result.between += isOpen && isShared[at(one[k])] && isShared[at(one[(k + 1) % 3])] ? 1U : 0U;
    result.crowded += isOpen ? 0U : 1U;
  }
  return result;
}

// Whether hardly an edge stays open between points that were brought together, or gets more than
// two triangles, as beside a fin: much of that was parted before.
bool isSewn(
  std::span<const Triangle> triangles, const std::vector<int>& alone, const std::vector<int>& onto)
{
  const Unpaired before = unpairedOf(triangles, alone);
  const Unpaired after = unpairedOf(triangles, onto);
  constexpr std::size_t kFew = 20; // times as many are sewn
  const std::size_t crowded = std::max(after.crowded, before.crowded) - before.crowded;
  return after.open < before.open && kFew * (after.between + crowded) <= before.open - after.open;
}

} // namespace

WeldedSeams weldSeams(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles)
{
  constexpr double kMost = 0.02;
  constexpr double kLeast = kMost / 16.0;
  constexpr double kNear = 0.1; // so that one wonders why it was left
  const Edges edges = edgesOf(points.size(), triangles);
  const auto within = [&](double ofEdge, bool closed = true)
  { return nearOnes(points, reachOf(points, edges, ofEdge, closed)); };
  const std::vector<int> alone = within(0.0);
  std::vector<int> onto = within(kLeast);
  for (double ofEdge = kLeast; ofEdge <= kMost; ofEdge *= 2.0)
  {
    std::vector<int> more = within(2.0 * ofEdge);
    // else it is a seam of which a part is sewn
    if (onto == more && onto != alone && isSewn(triangles, alone, onto))
    {
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        points[i] = points[at(onto[i])];
      }
      return { .isSewn = true };
    }
    onto = std::move(more);
  }
  onto = within(kNear, false);
  std::vector<bool> isNear(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (onto[i] != alone[i])
    {
      isNear[i] = isNear[at(onto[i])] = true;
    }
  }
  const auto left = std::ranges::count_if(
    edges.unpaired, [&](const auto& edge) { return isNear[at(edge[0])] && isNear[at(edge[1])]; });
  return { .left = static_cast<std::size_t>(left) };
}

} // namespace palp
