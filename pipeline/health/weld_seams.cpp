#include "pipeline/health/weld_seams.h"

#include "haptics/surface/edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

namespace palp
{
namespace
{

constexpr double kSeam = 1e-3; // [-] of an open edge

// how far each point may move to another; 0: it is at no open edge [m]
std::vector<double> reachesOf(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  std::vector<double> reach(points.size(), 0.0);
  for (const auto& [a, b] : edgesOf(points.size(), triangles).unpaired)
  {
    const double length = (points[at(a)] - points[at(b)]).norm();
    for (const int end : { a, b })
    {
      double& of = reach[at(end)];
      of = of > 0.0 ? std::min(of, kSeam * length) : kSeam * length;
    }
  }
  return reach;
}

} // namespace

bool weldSeams(std::vector<Eigen::Vector3d>& points, std::span<const Triangle> triangles)
{
  const std::vector<double> reach = reachesOf(points, triangles);
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
    return false;
  }
  Eigen::Index along = 0;
  box.sizes().maxCoeff(&along);
  std::ranges::sort(open, {}, [&](std::size_t i) { return points[i][along]; });
  std::vector<bool> isMoved(points.size());
  bool anyMoved = false;
  for (std::size_t i = 0; i < open.size(); ++i)
  {
    const std::size_t onto = open[i];
    for (std::size_t k = i + 1; k < open.size() && !isMoved[onto]; ++k)
    {
      const std::size_t other = open[k];
      if (points[other][along] - points[onto][along] > reach[onto])
      {
        break;
      }
      const double near = std::min(reach[onto], reach[other]);
      if (!isMoved[other] && (points[other] - points[onto]).norm() <= near)
      {
        points[other] = points[onto];
        isMoved[other] = true;
        anyMoved = true;
      }
    }
  }
  return anyMoved;
}

} // namespace palp
