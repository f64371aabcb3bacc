#include "haptics/surface/ray.h"

#include <algorithm>
#include <cmath>

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

// A ball of no stiffness, b in radius and its center z deep, takes 1.4 (b/z)^3 of a force at most,
// by the theory of nodules: 7 % from b = 0.37 z on.
constexpr double kNearHollow = 0.35;

// Where the body goes on beyond a wall by twice its thickness, nothing is known to hold the wall
// from behind, as that of a bowl: a dome of 12 mm, R 50, answers with 0.6 of the force of a held
// one.
constexpr double kFree = 2.0;

// whether a surface has a point that is farther along a direction
bool goesBeyond(const BoxTree& tree, const Eigen::Vector3d& direction, double farthest)
{
  bool found = false;
  tree.search(
    [&](const BoxTree::Node& box)
    {
      double most = 0.0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double along = direction[static_cast<Eigen::Index>(k)];
        most += along * static_cast<double>(along > 0.0 ? box.high[k] : box.low[k]);
      }
      return !found && most > farthest;
    },
    [&](int facet)
    {
      for (const Eigen::Vector3d& corner : tree.facets()[at(facet)].corners)
      {
        found = found || direction.dot(corner) > farthest;
      }
    });
  return found;
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

Below lookBelow(const BoxTree& tree, std::span<const float> hollows, const Eigen::Vector3d& from,
  const Eigen::Vector3d& inward) noexcept
{
  constexpr int kMost = 64; // walls
  constexpr double kBeyond = 1e-6;
  // so near, as places are known in single precision, a triangle is one of the same wall, turned
  // over
  const BoxTree::Node& all = tree.nodes()[0];
  const Eigen::Array3f size = Eigen::Array3f(all.high.data()) - Eigen::Array3f(all.low.data());
  Below below{ .thickness = kBeyond * static_cast<double>(size.matrix().norm()) };
  for (int wall = 0; wall < kMost; ++wall)
  {
    const RayHit hit = rayExit(tree, from + below.thickness * inward, inward);
    below.thickness += hit.distance;
    const double radius =
      hit.triangle < 0 ? 0.0 : static_cast<double>(hollows[static_cast<std::size_t>(hit.triangle)]);
    if (radius == 0.0)
    {
      const Eigen::Vector3d beyond = from + (1.0 + kBeyond) * below.thickness * inward;
      const double gap = rayEntry(tree, beyond, inward).distance; // as the width of a duct
      below.isHollow = below.isHollow ||
        (std::isfinite(gap) && 0.5 * gap > kNearHollow * (below.thickness + 0.5 * gap)) ||
        goesBeyond(tree, inward, inward.dot(beyond) + kFree * below.thickness);
      break;
    }
    below.isHollow = below.isHollow || radius > kNearHollow * (below.thickness + radius);
    below.thickness += kBeyond * radius;
  }
  return below;
}

} // namespace palp
