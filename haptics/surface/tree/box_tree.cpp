#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{
namespace
{

constexpr int kLeaf = 2; // facets: smaller leaves reject more of them, larger ones take fewer bytes
constexpr double kFlattest = 1e-12; // [-], area over squared longest edge of a usable triangle

struct Box
{
  Eigen::Array3f low = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;

  void add(const Box& other)
  {
    low = low.min(other.low);
    high = high.max(other.high);
  }
};

// a triangle waiting for its place in the tree; small, as each is moved once a level
struct Entry
{
  std::array<float, 3> middle; // twice that of its box
  int triangle;
};

float roundedDown(double value)
{
  const auto nearest = static_cast<float>(value);
  return static_cast<double>(nearest) <= value
    ? nearest
    : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

Box boxOf(const Facet& facet)
{
  Box box;
  for (const Eigen::Vector3d& corner : facet.corners)
  {
    const Eigen::Array3d x = corner.array();
    box.low = box.low.min(x.unaryExpr([](double v) { return roundedDown(v); }));
    box.high = box.high.max(x.unaryExpr([](double v) { return -roundedDown(-v); }));
  }
  return box;
}

// nothing when the triangle has no area
bool makeFacet(std::span<const Eigen::Vector3d> points, const Triangle& triangle, Facet& facet)
{
  for (std::size_t k = 0; k < 3; ++k)
  {
    facet.corners[k] = points[static_cast<std::size_t>(triangle[k])];
  }
  facet.normal = unitNormal(points, triangle);
  return !facet.normal.isZero(0.0);
}

void setBox(BoxTree::Node& node, const Box& box)
{
  node.low = { box.low[0], box.low[1], box.low[2] };
  node.high = { box.high[0], box.high[1], box.high[2] };
}

Box boxOf(const BoxTree::Node& node)
{
  return { .low = Eigen::Array3f(node.low.data()), .high = Eigen::Array3f(node.high.data()) };
}

// median split along the longest side of the box of the middles; the box of all that is below
Box split(std::vector<BoxTree::Node>& nodes, std::span<Entry> entries, int first,
  std::span<const Box> boxes)
{
  const std::size_t self = nodes.size();
  nodes.push_back(
    { .low = {}, .first = first, .high = {}, .count = static_cast<std::int32_t>(entries.size()) });
  Box box;
  if (entries.size() <= static_cast<std::size_t>(kLeaf))
  {
    std::ranges::for_each(entries, [&](const Entry& one) { box.add(boxes[at(one.triangle)]); });
    setBox(nodes[self], box);
    return box;
  }

  Box middles;
  for (const Entry& entry : entries)
  {
    const Eigen::Array3f middle(entry.middle.data());
    middles.add({ .low = middle, .high = middle });
  }
  std::size_t axis = 0;
  (middles.high - middles.low).maxCoeff(&axis);
  const std::size_t half = entries.size() / 2;
  std::nth_element(entries.begin(), entries.begin() + static_cast<std::ptrdiff_t>(half),
    entries.end(),
    [axis](const Entry& a, const Entry& b) { return a.middle[axis] < b.middle[axis]; });
  nodes[self].count = 0;
  box = split(nodes, entries.first(half), first, boxes);
  nodes[self].first = static_cast<std::int32_t>(nodes.size());
  box.add(split(nodes, entries.subspan(half), first + static_cast<int>(half), boxes));
  setBox(nodes[self], box);
  return box;
}

} // namespace

bool isWithin(const Facet& facet, const Eigen::Vector3d& position, double margin) noexcept
{
  const auto& [a, b, c] = facet.corners;
  const double least = margin * (b - a).cross(c - a).norm();
  return (b - a).cross(position - a).dot(facet.normal) >= least &&
    (c - b).cross(position - b).dot(facet.normal) >= least &&
    (a - c).cross(position - c).dot(facet.normal) >= least;
}

Eigen::Vector3d unitNormal(
  std::span<const Eigen::Vector3d> points, const Triangle& triangle) noexcept
{
  const Eigen::Vector3d& a = points[static_cast<std::size_t>(triangle[0])];
  const Eigen::Vector3d u = points[static_cast<std::size_t>(triangle[1])] - a;
  const Eigen::Vector3d v = points[static_cast<std::size_t>(triangle[2])] - a;
  const Eigen::Vector3d cross = u.cross(v);
  const double longest = std::max({ u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm() });
  const double area = cross.norm();
  return area > kFlattest * longest ? cross / area : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

BoxTree::BoxTree(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  std::vector<Entry> entries;
  entries.reserve(triangles.size());
  std::vector<Box> boxes(triangles.size());
  Facet facet;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    if (makeFacet(points, triangles[i], facet))
    {
      boxes[i] = boxOf(facet);
      const Eigen::Array3f middle = boxes[i].low + boxes[i].high;
      entries.push_back({ { middle[0], middle[1], middle[2] }, static_cast<int>(i) });
    }
  }
  if (entries.empty())
  {
    return;
  }
  nodes_.reserve(entries.size());
  (void)split(nodes_, entries, 0, boxes);

  facets_.reserve(entries.size());
  order_.reserve(entries.size());
  for (const Entry& entry : entries)
  {
    (void)makeFacet(points, triangles[static_cast<std::size_t>(entry.triangle)], facet);
    facets_.push_back(facet);
    order_.push_back(entry.triangle);
  }
}

BoxTree BoxTree::moved(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles) const
{
  BoxTree result = *this;
  bool isSame = facets_.size() == triangles.size();
  for (std::size_t i = 0; i < facets_.size() && isSame; ++i)
  {
    isSame = makeFacet(points, triangles[at(order_[i])], result.facets_[i]);
  }
  if (!isSame)
  {
    return { points, triangles }; // other ones have no area
  }
  for (std::size_t i = result.nodes_.size(); i-- > 0;) // what is below a node follows it
  {
    Node& node = result.nodes_[i];
    Box box;
    for (int k = node.first; k < node.first + node.count; ++k)
    {
      box.add(boxOf(result.facets_[at(k)]));
    }
    if (node.count == 0)
    {
      box = boxOf(result.nodes_[i + 1]);
      box.add(boxOf(result.nodes_[at(node.first)]));
    }
    setBox(node, box);
  }
  return result;
}

} // namespace palp
