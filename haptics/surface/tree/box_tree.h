#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palp
{

using Triangle = std::array<int, 3>; ///< point indices, counter-clockwise from outside

/// Where an index of a point or triangle leads in a vector.
[[nodiscard]] constexpr std::size_t at(int index) noexcept
{
  return static_cast<std::size_t>(index);
}

/// Outward unit normal of a triangle; zero where it has no area, but for rounding.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Eigen::Vector3d unitNormal(
  std::span<const Eigen::Vector3d> points, const Triangle& triangle) noexcept;

/// One triangle as the search needs it, in the order in which the tree meets it.
struct Facet
{
  std::array<Eigen::Vector3d, 3> corners; ///< [m]
  Eigen::Vector3d normal;                 ///< outward unit normal
};

/// Whether a place in the plane of a facet is on it.
///
/// @param margin  by which it must lie within each edge, as a share of the facet's height over that
///                edge [-]; negative: as far outside still counts
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] bool isWithin(
  const Facet& facet, const Eigen::Vector3d& position, double margin) noexcept;

/// Flat tree of boxes over triangles, nodes and facets in depth-first order.
///
/// Boxes are single precision, rounded outwards: half the bytes, never too small. A triangle
/// without area has no normal and is left out; its edges belong to its neighbors as well. Of our
/// own: the servo thread walks it without a lock or an allocation, which VTK's locators do not
/// promise.
class BoxTree
{
public:
  struct Node
  {
    std::array<float, 3> low;  ///< [m]
    std::int32_t first;        ///< leaf: its first facet; else the right child
    std::array<float, 3> high; ///< [m]
    std::int32_t count;        ///< leaf: its facets; 0 in an inner node, whose left child follows
  };

  BoxTree() = default;

  /// @param points     finite [m]
  /// @param triangles  indices within points
  BoxTree(std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);

  /// The tree of the same triangles over points that have moved a little, for a third of the time.
  /// @param points     finite [m]
  /// @param triangles  that this was built of
  [[nodiscard]] BoxTree moved(
    std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles) const;

  [[nodiscard]] bool empty() const noexcept
  {
    return nodes_.empty();
  }
  [[nodiscard]] std::span<const Node> nodes() const noexcept
  {
    return nodes_;
  }
  [[nodiscard]] std::span<const Facet> facets() const noexcept
  {
    return facets_;
  }

  /// Triangle that a facet was made from.
  [[nodiscard]] int triangle(int facet) const noexcept
  {
    return order_[static_cast<std::size_t>(facet)];
  }

  /// Calls visit(facet index) for all facets of the leaves whose boxes are wanted.
  ///
  /// @param wanted  bool(const Node&): whether to look into a box
  /// @realtime      no allocation, no lock; no exception if the callables throw none
  template <typename Wanted, typename Visit>
  void search(Wanted wanted, Visit visit) const noexcept
  {
    std::array<std::int32_t, kDepth> stack;
    std::size_t waiting = 0;
    std::int32_t current = empty() ? -1 : 0;
    while (current >= 0)
    {
      const Node& node = nodes_[static_cast<std::size_t>(current)];
      const bool inside = wanted(node);
      if (inside && node.count == 0)
      {
        stack[waiting++] = node.first;
        ++current;
        continue;
      }
      for (std::int32_t i = 0; inside && i < node.count; ++i)
      {
        visit(node.first + i);
      }
      current = waiting > 0 ? stack[--waiting] : -1;
    }
  }

  /// Levels of the deepest tree: halving 2^31 triangles takes fewer.
  static constexpr std::size_t kDepth = 40;

private:
  std::vector<Node> nodes_;
  std::vector<Facet> facets_;
  std::vector<int> order_;
};

/// Squared distance of a point to a box, 0 inside [m^2].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline double squaredDistance(
  const BoxTree::Node& box, const Eigen::Vector3d& point) noexcept
{
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double x = point[static_cast<Eigen::Index>(k)];
    const double below = static_cast<double>(box.low[k]) - x;
    const double above = x - static_cast<double>(box.high[k]);
    const double gap = below > above ? below : above;
    sum += gap > 0.0 ? gap * gap : 0.0;
  }
  return sum;
}

/// The largest squared distance of a point to anything in a box [m^2].
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline double squaredReach(
  const BoxTree::Node& box, const Eigen::Vector3d& point) noexcept
{
  double sum = 0.0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double x = point[static_cast<Eigen::Index>(k)];
    const double below = x - static_cast<double>(box.low[k]);
    const double above = static_cast<double>(box.high[k]) - x;
    const double farther = below > above ? below : above;
    sum += farther * farther;
  }
  return sum;
}

} // namespace palp
