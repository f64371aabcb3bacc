#include "haptics/contact/nearest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

// what of a triangle is nearest: its face, the edge from corner k to k + 1, or corner k
enum class Feature
{
  Face,
  Edge,
  Corner,
};

struct OnFacet
{
  Eigen::Vector3d point;
  Feature feature;
  int k;
};

OnFacet nearestOnFacet(const Facet& facet, const Eigen::Vector3d& p) noexcept
{
  const auto& [a, b, c] = facet.corners;
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return { a, Feature::Corner, 0 };
  }
  const double d3 = d1 - ab.squaredNorm();
  const double d4 = d2 - ab.dot(ac);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return { b, Feature::Corner, 1 };
  }
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
  {
    return { a + d1 / (d1 - d3) * ab, Feature::Edge, 0 };
  }
  const double d5 = d1 - ab.dot(ac);
  const double d6 = d2 - ac.squaredNorm();
  if (d6 >= 0.0 && d5 <= d6)
  {
    return { c, Feature::Corner, 2 };
  }
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
  {
    return { a + d2 / (d2 - d6) * ac, Feature::Edge, 2 };
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
  {
    return { b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), Feature::Edge, 1 };
  }
  return { a + (vb * ab + vc * ac) / (va + vb + vc), Feature::Face, 0 };
}

Eigen::Vector3d normalOf(const Surface& surface, int triangle) noexcept
{
  const auto points = surface.points();
  const Triangle& t = surface.triangles()[static_cast<std::size_t>(triangle)];
  const Eigen::Vector3d& a = points[static_cast<std::size_t>(t[0])];
  return (points[static_cast<std::size_t>(t[1])] - a)
    .cross(points[static_cast<std::size_t>(t[2])] - a)
    .normalized();
}

// normal that tells inside from outside at a feature, and whether the surface ends there
std::pair<Eigen::Vector3d, bool> sideOf(
  const Surface& surface, const Facet& facet, int triangle, const OnFacet& hit) noexcept
{
  if (hit.feature == Feature::Corner)
  {
    const int point =
      surface.triangles()[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(hit.k)];
    return { surface.normals()[static_cast<std::size_t>(point)], surface.onOpenEdge(point) };
  }
  const int other = hit.feature == Feature::Edge ? surface.across(triangle, hit.k) : -1;
  if (other >= 0)
  {
    return { (facet.normal + normalOf(surface, other)).normalized(), false };
  }
  return { facet.normal, hit.feature == Feature::Edge };
}

} // namespace

Nearest findNearest(const Surface& surface, const Eigen::Vector3d& place, double reach) noexcept
{
  const BoxTree& tree = surface.tree();
  const auto nodes = tree.nodes();
  struct Waiting
  {
    std::int32_t node;
    double squared;
  };
  std::array<Waiting, BoxTree::kDepth> stack;
  std::size_t waiting = 0;
  double best = reach * reach;
  int bestFacet = -1;
  OnFacet hit{};
  Waiting current{ 0, tree.empty() ? best : squaredDistance(nodes[0], place) };
  while (true)
  {
    if (current.squared < best)
    {
      const BoxTree::Node& node = nodes[static_cast<std::size_t>(current.node)];
      if (node.count == 0)
      {
        // the nearer child first: it shortens the reach for the other
        Waiting near{ current.node + 1,
          squaredDistance(nodes[static_cast<std::size_t>(current.node) + 1], place) };
        Waiting far{ node.first,
          squaredDistance(nodes[static_cast<std::size_t>(node.first)], place) };
        if (far.squared < near.squared)
        {
          std::swap(near, far);
        }
        if (far.squared < best)
        {
          stack[waiting++] = far;
        }
        current = near;
        continue;
      }
      for (int i = node.first; i < node.first + node.count; ++i)
      {
        const OnFacet candidate = nearestOnFacet(tree.facets()[static_cast<std::size_t>(i)], place);
        const double squared = (candidate.point - place).squaredNorm();
        if (squared < best)
        {
          best = squared;
          bestFacet = i;
          hit = candidate;
        }
      }
    }
    if (waiting == 0)
    {
      break;
    }
    current = stack[--waiting];
  }
  if (bestFacet < 0)
  {
    return {};
  }

  const int triangle = tree.triangle(bestFacet);
  const auto [normal, open] =
    sideOf(surface, tree.facets()[static_cast<std::size_t>(bestFacet)], triangle, hit);
  const double distance = std::sqrt(best);
  const double height = normal.dot(place - hit.point);
  if (height >= 0.0)
  {
    return { triangle, hit.point, distance };
  }
  const double beside = open ? std::sqrt(std::max(0.0, best - height * height)) : 0.0;
  return { triangle, hit.point, open ? beside + height : -distance };
}

double distanceToFarSide(
  const Surface& surface, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) noexcept
{
  double nearest = std::numeric_limits<double>::infinity();
  const Eigen::Array3d inverse = direction.array().inverse(); // infinite along an axis: as wanted
  const auto crosses = [&](const BoxTree::Node& box)
  {
    double enter = 0.0;
    double leave = nearest;
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
    const Facet& facet = surface.tree().facets()[static_cast<std::size_t>(i)];
    const double outward = facet.normal.dot(direction);
    if (!(outward > 0.0))
    {
      return;
    }
    const auto& [a, b, c] = facet.corners;
    const double t = facet.normal.dot(a - origin) / outward;
    const Eigen::Vector3d x = origin + t * direction;
    const bool within = (b - a).cross(x - a).dot(facet.normal) >= 0.0 &&
      (c - b).cross(x - b).dot(facet.normal) >= 0.0 &&
      (a - c).cross(x - c).dot(facet.normal) >= 0.0;
    if (within && t > 0.0 && t < nearest)
    {
      nearest = t;
    }
  };
  surface.tree().search(crosses, visit);
  return nearest;
}

} // namespace palp
