#include "haptics/surface/crossing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kTouching = 1e-6; // [-] of an edge or an area: less is rounding

// where a line passes through a facet
struct Pierced
{
  Eigen::Vector3d place;
  double above;       // of the line's begin over the facet [m]
  unsigned int sides; // of the facet that pass through there: a bit for each; 0: its middle does
};

std::optional<Pierced> pierced(
  const Facet& facet, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double above = facet.normal.dot(a - facet.corners[0]);
  const double below = facet.normal.dot(b - facet.corners[0]);
  if (above * below >= 0.0 ||
    std::min(std::abs(above), std::abs(below)) < kTouching * (b - a).norm())
  {
    return std::nullopt;
  }
  Pierced found{ .place = a + above / (above - below) * (b - a), .above = above, .sides = 0 };
  if (!isWithin(facet, found.place, -kTouching))
  {
    return std::nullopt;
  }
  const auto& p = facet.corners;
  const double least = kTouching * (p[1] - p[0]).cross(p[2] - p[0]).norm();
  for (std::size_t k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d side = p[(k + 1) % 3] - p[k];
    const bool isOn = side.cross(found.place - p[k]).dot(facet.normal) < least;
    found.sides |= isOn ? 1U << k : 0U;
  }
  return found;
}

// An edge that meets a side or a corner of a triangle. It passes through the surface there where it
// does so in one sense through all the triangles that share it, else it only touches.
struct Touch
{
  std::array<int, 4> where; // points of the edge, and of the side or corner, each in order
  bool isDown;              // through the triangle, from the edge's lower point
  int own;                  // triangle of the edge
  int other;
  Eigen::Vector3d place;
};

std::array<int, 4> whereOf(
  const std::array<int, 2>& edge, const Triangle& other, unsigned int sides)
{
  const auto k = static_cast<std::size_t>(std::countr_zero(sides));
  std::array ends{ other[k], other[(k + 1) % 3] };
  if (std::popcount(sides) > 1) // the corner that both have
  {
    ends.fill(sides == 5U ? other[0] : ends[1]);
  }
  return { std::min(edge[0], edge[1]), std::max(edge[0], edge[1]), std::min(ends[0], ends[1]),
    std::max(ends[0], ends[1]) };
}

// visits those that pass through, while that asks for more
template <typename Visit>
void forPassing(std::vector<Touch>& touches, Visit visit)
{
  std::ranges::sort(touches, {}, &Touch::where);
  for (auto first = touches.begin(); first != touches.end();)
  {
    const auto last = std::find_if(
      first, touches.end(), [&](const Touch& one) { return one.where != first->where; });
    const bool isPassing =
      std::all_of(first, last, [&](const Touch& one) { return one.isDown == first->isDown; }) &&
      std::any_of(first, last, [&](const Touch& one) { return one.other != first->other; });
    for (; first != last; ++first)
    {
      if (isPassing && !visit(first->own, first->other, first->place))
      {
        return;
      }
    }
  }
}

// the box of a facet, made once for all that it is compared with
class FacetBox
{
public:
  explicit FacetBox(const Facet& facet)
    : low_(facet.corners[0].cwiseMin(facet.corners[1]).cwiseMin(facet.corners[2]))
    , high_(facet.corners[0].cwiseMax(facet.corners[1]).cwiseMax(facet.corners[2]))
  {
  }

  [[nodiscard]] bool overlaps(const BoxTree::Node& box) const noexcept
  {
    bool isApart = false;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto axis = static_cast<Eigen::Index>(k);
      isApart = isApart || low_[axis] > static_cast<double>(box.high[k]) ||
        high_[axis] < static_cast<double>(box.low[k]);
    }
    return !isApart;
  }

private:
  Eigen::Vector3d low_;
  Eigen::Vector3d high_;
};

bool overlap(const BoxTree::Node& a, const BoxTree::Node& b) noexcept
{
  bool isApart = false;
  for (std::size_t k = 0; k < 3; ++k)
  {
    isApart = isApart || a.low[k] > b.high[k] || a.high[k] < b.low[k];
  }
  return !isApart;
}

// Visits all pairs of facets in two parts of a tree, or within one, whose boxes overlap; each once,
// while that asks for more.
template <typename Visit>
bool forPairs(const BoxTree& tree, int one, int other, Visit& visit)
{
  const BoxTree::Node& a = tree.nodes()[at(one)];
  const BoxTree::Node& b = tree.nodes()[at(other)];
  if (!overlap(a, b))
  {
    return true;
  }
  if (a.count > 0 && b.count > 0)
  {
    bool more = true;
    for (int i = a.first; i < a.first + a.count && more; ++i)
    {
      for (int j = one == other ? i + 1 : b.first; j < b.first + b.count && more; ++j)
      {
        more = visit(i, j);
      }
    }
    return more;
  }
  if (one == other)
  {
    return forPairs(tree, one + 1, one + 1, visit) && forPairs(tree, a.first, a.first, visit) &&
      forPairs(tree, one + 1, a.first, visit);
  }
  const auto size = [](const BoxTree::Node& node) // of the box, as far as which is larger goes
  { return node.high[0] - node.low[0] + node.high[1] - node.low[1] + node.high[2] - node.low[2]; };
  const bool splitsOne = b.count > 0 || (a.count == 0 && size(a) > size(b));
  return splitsOne ? forPairs(tree, one + 1, other, visit) && forPairs(tree, a.first, other, visit)
                   : forPairs(tree, one, other + 1, visit) && forPairs(tree, one, b.first, visit);
}

// visits the places where an edge of a facet passes through another one, while that asks for more
template <typename Visit>
void forCrossings(const BoxTree& tree, std::span<const Triangle> triangles, Visit visit)
{
  std::vector<Touch> touches;
  const auto passes = [&](int i, int j)
  {
    const Facet& facet = tree.facets()[at(i)];
    const Triangle& own = triangles[at(tree.triangle(i))];
    const Triangle& other = triangles[at(tree.triangle(j))];
    const auto isShared = [&](int point) { return std::ranges::count(other, point) > 0; };
    const std::array shared{ isShared(own[0]), isShared(own[1]), isShared(own[2]) };
    bool more = true;
    for (std::size_t k = 0; k < 3 && more; ++k)
    {
      const std::size_t next = (k + 1) % 3;
      if (shared[k] || shared[next])
      {
        continue;
      }
      const auto found = pierced(tree.facets()[at(j)], facet.corners[k], facet.corners[next]);
      if (found && found->sides == 0)
      {
        more = visit(tree.triangle(i), tree.triangle(j), found->place);
      }
      else if (found)
      {
        touches.push_back({ .where = whereOf({ own[k], own[next] }, other, found->sides),
          .isDown = (found->above > 0.0) == (own[k] < own[next]),
          .own = tree.triangle(i),
          .other = tree.triangle(j),
          .place = found->place });
      }
    }
    return more;
  };
  const auto both = [&](int i, int j) { return passes(i, j) && passes(j, i); };
  if (tree.empty() || forPairs(tree, 0, 0, both))
  {
    forPassing(touches, visit);
  }
}

} // namespace

std::optional<Eigen::Vector3d> findCrossing(
  const BoxTree& tree, std::span<const Triangle> triangles)
{
  std::optional<Eigen::Vector3d> found;
  forCrossings(tree, triangles,
    [&](int, int, const Eigen::Vector3d& place)
    {
      found = place;
      return false;
    });
  return found;
}

double asideOf(const BoxTree& tree) noexcept
{
  constexpr double kAside = 1e-4; // edge lengths
  double sum = 0.0;
  for (const Facet& facet : tree.facets())
  {
    sum += (facet.corners[1] - facet.corners[0]).squaredNorm();
  }
  return kAside * std::sqrt(sum / static_cast<double>(tree.facets().size()));
}

bool isBuried(const Winding& winding, const Facet& facet, double aside) noexcept
{
  const auto& [a, b, c] = facet.corners;
  const Eigen::Vector3d middle = (a + b + c) / 3.0;
  const bool isInside = winding(middle - aside * facet.normal) > 0.5;
  return isInside == (winding(middle + aside * facet.normal) > 0.5);
}

std::vector<int> buriedTriangles(const BoxTree& tree, std::span<const int> pieces)
{
  std::vector<int> all;
  if (std::ranges::all_of(pieces, [](int piece) { return piece == 0; }))
  {
    return all;
  }
  const Winding winding(tree);
  const double aside = asideOf(tree);
  for (int i = 0; at(i) < tree.facets().size(); ++i)
  {
    const Facet& facet = tree.facets()[at(i)];
    const int own = pieces[at(tree.triangle(i))];
    bool isNear = false;
    const FacetBox bounds(facet);
    tree.search([&](const BoxTree::Node& box) { return !isNear && bounds.overlaps(box); },
      [&](int j) { isNear = isNear || pieces[at(tree.triangle(j))] != own; });
    if (isNear && isBuried(winding, facet, aside))
    {
      all.push_back(tree.triangle(i));
    }
  }
  std::ranges::sort(all);
  return all;
}

std::vector<std::array<int, 2>> crossingPairs(
  const BoxTree& tree, std::span<const Triangle> triangles)
{
  std::vector<std::array<int, 2>> all;
  forCrossings(tree, triangles,
    [&](int one, int other, const Eigen::Vector3d&)
    {
      all.push_back({ std::min(one, other), std::max(one, other) });
      return true;
    });
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<int> crossingTriangles(const BoxTree& tree, std::span<const Triangle> triangles)
{
  std::vector<int> all;
  for (const auto& [one, other] : crossingPairs(tree, triangles))
  {
    all.insert(all.end(), { one, other });
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

} // namespace palp
