#include "haptics/surface/crossing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace palp
{
namespace
{

constexpr double kTouching = 1e-6; // [-] of an edge or an area: less is rounding

// where the line from a to b passes through the middle of a facet
std::optional<Eigen::Vector3d> pierced(
  const Facet& facet, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double above = facet.normal.dot(a - facet.corners[0]);
  const double below = facet.normal.dot(b - facet.corners[0]);
  if (above * below >= 0.0 ||
    std::min(std::abs(above), std::abs(below)) < kTouching * (b - a).norm())
  {
    return std::nullopt;
  }
  const Eigen::Vector3d x = a + above / (above - below) * (b - a);
  return isWithin(facet, x, kTouching) ? std::optional(x) : std::nullopt;
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
      if (!shared[k] && !shared[next])
      {
        const auto place = pierced(tree.facets()[at(j)], facet.corners[k], facet.corners[next]);
        more = !place || visit(tree.triangle(i), tree.triangle(j), *place);
      }
    }
    return more;
  };
  const auto both = [&](int i, int j) { return passes(i, j) && passes(j, i); };
  tree.empty() || forPairs(tree, 0, 0, both);
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
