#include "haptics/surface/closest_point.h"

#include "haptics/numerics/box_probe.h"

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
    const Triangle& across = surface.triangles()[static_cast<std::size_t>(other)];
    return { (facet.normal + unitNormal(surface.points(), across)).normalized(), false };
  }
  return { facet.normal, hit.feature == Feature::Edge };
}

// the nearest of the facets that were looked at
struct Closest
{
  double squared; // distance [m^2]
  int facet = -1;
  OnFacet hit{};

  void look(
    const BoxTree& tree, const BoxTree::Node& leaf, const Eigen::Vector3d& position) noexcept
  {
    for (int i = leaf.first; i < leaf.first + leaf.count; ++i)
    {
      const OnFacet candidate =
        nearestOnFacet(tree.facets()[static_cast<std::size_t>(i)], position);
      const double distance = (candidate.point - position).squaredNorm();
      if (distance < squared)
      {
        *this = { distance, i, candidate };
      }
    }
  }
};

// a box that may hold something nearer
struct Waiting
{
  std::int32_t node;
  float squared; // distance, at most [m^2]
};

// enough: whatever is as near will do
Closest closestFacet(
  const BoxTree& tree, const Eigen::Vector3d& position, double reach, double enough = 0.0) noexcept
{
  const auto nodes = tree.nodes();
  const BoxProbe probe(position);
  const auto boxOf = [&](std::int32_t node) {
    return Waiting{ node, probe.squaredDistance(nodes[static_cast<std::size_t>(node)]) };
  };
  std::array<Waiting, BoxTree::kDepth> stack;
  std::size_t waiting = 0;
  Closest best{ .squared = reach * reach };
  for (Waiting current = tree.empty() ? Waiting{ 0, std::numeric_limits<float>::infinity() }
                                      : boxOf(0);
       ;)
  {
    while (static_cast<double>(current.squared) < best.squared)
    {
      const BoxTree::Node& node = nodes[static_cast<std::size_t>(current.node)];
      if (node.count > 0)
      {
        best.look(tree, node, position);
        break;
      }
      // the nearer child first: it shortens the reach for the other
      const Waiting left = boxOf(current.node + 1);
      const Waiting right = boxOf(node.first);
      const bool rightFirst = right.squared < left.squared;
      current = rightFirst ? right : left;
      if (const Waiting& far = rightFirst ? left : right;
          static_cast<double>(far.squared) < best.squared)
      {
        stack[waiting++] = far;
      }
    }
    if (waiting == 0 || best.squared <= enough * enough)
    {
      return best;
    }
    current = stack[--waiting];
  }
}

} // namespace

double distanceTo(
  const BoxTree& tree, const Eigen::Vector3d& position, double reach, double enough) noexcept
{
  return std::sqrt(closestFacet(tree, position, reach, enough).squared);
}

ClosestPoint findClosestPoint(
  const Surface& surface, const Eigen::Vector3d& position, double reach) noexcept
{
  const BoxTree& tree = surface.tree();
  const Closest best = closestFacet(tree, position, reach);
  if (best.facet < 0)
  {
    return {};
  }
  const OnFacet& hit = best.hit;
  const int triangle = tree.triangle(best.facet);
  const double distance = std::sqrt(best.squared);
  if (const auto& winding = surface.winding()) // the nearest triangle may be one of a fold
  {
    return { triangle, hit.point, (*winding)(position) > 0.5 ? -distance : distance };
  }
  const auto [normal, open] =
    sideOf(surface, tree.facets()[static_cast<std::size_t>(best.facet)], triangle, hit);
  const double height = normal.dot(position - hit.point);
  if (height >= 0.0)
  {
    return { triangle, hit.point, distance };
  }
  const double beside = open ? std::sqrt(std::max(0.0, best.squared - height * height)) : 0.0;
  return { triangle, hit.point, open ? beside + height : -distance };
}

} // namespace palp
