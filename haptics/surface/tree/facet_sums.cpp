#include "haptics/surface/tree/facet_sums.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace palp
{
namespace
{

constexpr std::int32_t kFewest = 5;  // facets: fewer are visited as soon
constexpr std::int32_t kMost = 1024; // more are hardly ever wholly within a tool's reach

void add(FacetSum& sum, const Facet& facet)
{
  const Eigen::Vector3d& n = facet.normal;
  const Eigen::Vector3d a = facet.corners[0] - sum.origin;
  const Eigen::Vector3d b = facet.corners[1] - sum.origin;
  const Eigen::Vector3d c = facet.corners[2] - sum.origin;
  const Eigen::Vector3d corners = a + b + c;
  const double area = 0.5 * n.dot((b - a).cross(c - a));
  const Eigen::Vector3d place = area / 3.0 * corners;
  const double squares =
    area / 12.0 * (a.squaredNorm() + b.squaredNorm() + c.squaredNorm() + corners.squaredNorm());
  const double height = n.dot(a);
  sum.area += area;
  sum.place += place;
  sum.squares += squares;
  sum.normal += area * n;
  sum.normalPlace += n * place.transpose();
  sum.normalSquares += squares * n;
  sum.height += area * height;
  sum.heightPlace += height * place;
  sum.heightSquares += height * squares;
}

FacetSum sumOf(std::span<const Facet> facets)
{
  FacetSum sum;
  for (const Facet& facet : facets)
  {
    sum.origin += facet.corners[0] / static_cast<double>(facets.size());
  }
  for (const Facet& facet : facets)
  {
    add(sum, facet);
  }
  sum.axis = sum.normal.normalized();
  sum.low = std::numeric_limits<double>::infinity();
  sum.high = -sum.low;
  for (const Facet& facet : facets)
  {
    sum.cosine = std::min(sum.cosine, sum.axis.dot(facet.normal));
    for (const Eigen::Vector3d& corner : facet.corners)
    {
      const double along = sum.axis.dot(corner - sum.origin);
      sum.low = std::min(sum.low, along);
      sum.high = std::max(sum.high, along);
    }
  }
  sum.sine = std::sqrt(std::max(0.0, 1.0 - sum.cosine * sum.cosine));
  return sum;
}

// facets from first up to end below a node, whose index moves on to the next beside it
struct Span
{
  std::int32_t first;
  std::int32_t end;
};

template <typename Use>
Span walk(std::span<const BoxTree::Node> nodes, std::size_t& node, Use& use)
{
  const std::size_t self = node++;
  Span span{ nodes[self].first, nodes[self].first + nodes[self].count };
  if (nodes[self].count == 0)
  {
    span.first = walk(nodes, node, use).first;
    span.end = walk(nodes, node, use).end;
  }
  use(self, span);
  return span;
}

} // namespace

bool FacetSum::areAllSeen(const Eigen::Vector3d& center, double reach, double side) const noexcept
{
  const double along = axis.dot(center - origin);
  const double over = side > 0.0 ? along - high : low - along;
  return cosine > 0.0 && over > 0.0 && cosine * over >= sine * reach;
}

FacetSums::FacetSums(const BoxTree& tree, const std::vector<std::uint8_t>& openSides)
  : index_(tree.nodes().size(), -1)
{
  const std::span<const Facet> facets = tree.facets();
  std::vector<std::int32_t> open(facets.size() + 1, 0); // so many before
  for (std::size_t i = 0; i < facets.size(); ++i)
  {
    open[i + 1] = open[i] + (openSides[at(tree.triangle(static_cast<int>(i)))] != 0 ? 1 : 0);
  }
  if (open.back() > 0)
  {
    open_.resize(facets.size());
    for (std::size_t i = 0; i < facets.size(); ++i)
    {
      open_[i] = openSides[at(tree.triangle(static_cast<int>(i)))];
    }
  }
  const auto use = [&](std::size_t node, const Span& span)
  {
    const std::int32_t count = span.end - span.first;
    if (count >= kFewest && count <= kMost && open[at(span.end)] == open[at(span.first)])
    {
      index_[node] = static_cast<std::int32_t>(sums_.size());
      sums_.push_back(sumOf(facets.subspan(at(span.first), at(count))));
    }
  };
  std::size_t root = 0;
  if (!tree.empty())
  {
    (void)walk(tree.nodes(), root, use);
  }
}

} // namespace palp
