#include "haptics/surface/ray.h"

#include <algorithm>

namespace palp
{
namespace
{

constexpr double kOverlap = 1e-9; // of triangles under a ray, by their height [-]

// side: 1 where the ray leaves through a facet, -1 where it enters
RayHit firstHit(const BoxTree& tree, const Eigen::Vector3d& origin,
  const Eigen::Vector3d& direction, double side) noexcept
{
  RayHit first;
  const Eigen::Array3d inverse = direction.array().inverse(); // infinite along an axis: as wanted
  const auto crosses = [&](const BoxTree::Node& box)
  {
    double enter = 0.0;
    double leave = first.distance;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto axis = static_cast<Eigen::Index>(k);
      const double t0 = (static_cast<double>(box.low[k]) - origin[axis]) * inverse[axis];
      const double t1 = (static_cast<double>(box.high[k]) - origin[axis]) * inverse[axis];
      // comparisons with NaN, from a ray within a side of the box, leave the interval as it is
      enter = std::min(t0, t1) > enter ? std::min(t0, t1) : enter;
      leave = std::max(t0, t1) < leave ? std::max(t0, t1) : leave;
    }
    return enter <= leave;
  };
  const auto visit = [&](int i)
  {
    const Facet& facet = tree.facets()[static_cast<std::size_t>(i)];
    const double along = facet.normal.dot(direction);
    if (!(side * along > 0.0))
    {
      return;
    }
    const double t = facet.normal.dot(facet.corners[0] - origin) / along;
    if (t > 0.0 && t < first.distance && isWithin(facet, origin + t * direction, -kOverlap))
    {
      first = { tree.triangle(i), t };
    }
  };
  tree.search(crosses, visit);
  return first;
}

} // namespace

RayHit rayEntry(
  const BoxTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) noexcept
{
  return firstHit(tree, origin, direction, -1.0);
}

RayHit rayExit(
  const BoxTree& tree, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) noexcept
{
  return firstHit(tree, origin, direction, 1.0);
}

} // namespace palp
