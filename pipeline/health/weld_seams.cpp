#include "pipeline/health/weld_seams.h"

#include "haptics/surface/edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <numeric>

namespace palp
{
namespace
{

// how far each point may move to another; 0: it is at no open edge [m]
std::vector<double> reachesOf(
  std::span<const Eigen::Vector3d> points, const Edges& edges, double ofEdge)
{
  std::vector<double> reach(points.size(), 0.0);
  for (const auto& [a, b] : edges.unpaired)
  {
    const double most = ofEdge * (points[at(a)] - points[at(b)]).norm();
    for (const int end : { a, b })
    {
      double& of = reach[at(end)];
      of = of > 0.0 ? std::min(of, most) : most;
    }
  }
  return reach;
}

// the point to which each goes: itself, or another
std::vector<int> nearOnes(std::span<const Eigen::Vector3d> points, std::span<const double> reach)
{
  std::vector<int> onto(points.size());
  std::iota(onto.begin(), onto.end(), 0);
  std::vector<std::size_t> open;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (reach[i] > 0.0)
    {
      open.push_back(i);
      box.extend(points[i]);
    }
  }
  if (open.empty())
  {
    return onto;
  }
  Eigen::Index along = 0;
  box.sizes().maxCoeff(&along);
  std::ranges::sort(open, {}, [&](std::size_t i) { return points[i][along]; });
  for (std::size_t i = 0; i < open.size(); ++i)
  {
    const std::size_t one = open[i];
    for (std::size_t k = i + 1; k < open.size() && at(onto[one]) == one; ++k)
    {
      const std::size_t other = open[k];
      if (points[other][along] - points[one][along] > reach[one])
      {
        break;
      }
      const double near = std::min(reach[one], reach[other]);
      if (at(onto[other]) == other && (points[other] - points[one]).norm() <= near)
      {
        onto[other] = static_cast<int>(one);
      }
    }
  }
  return onto;
}

// whether hardly an edge stays open between points that were brought together
bool isSewn(std::span<const Triangle> triangles, const Edges& before, const std::vector<int>& onto)
{
  std::vector<Triangle> sewn(triangles.begin(), triangles.end());
  std::vector<bool> isShared(onto.size());
  for (std::size_t i = 0; i < onto.size(); ++i)
  {
    isShared[at(onto[i])] = isShared[at(onto[i])] || at(onto[i]) != i;
  }
  for (Triangle& triangle : sewn)
  {
    std::ranges::transform(triangle, triangle.begin(), [&](int i) { return onto[at(i)]; });
  }
  const Edges after = edgesOf(onto.size(), sewn);
  const auto left = static_cast<std::size_t>(std::ranges::count_if(after.unpaired,
    [&](const auto& edge) { return isShared[at(edge[0])] && isShared[at(edge[1])]; }));
  constexpr std::size_t kFew = 20; // times as many are sewn
  return after.crowded <= before.crowded && after.unpaired.size() < before.unpaired.size() &&
    kFew * left <= before.unpaired.size() - after.unpaired.size();
}

} // namespace

bool weldSeams(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles)
{
  const Edges edges = edgesOf(points.size(), triangles);
  for (const double ofEdge : { 1e-3, 1e-2 })
  {
    const std::vector<int> onto = nearOnes(points, reachesOf(points, edges, ofEdge));
    if (isSewn(triangles, edges, onto))
    {
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        points[i] = points[at(onto[i])];
      }
      return true;
    }
  }
  return false;
}

} // namespace palp
