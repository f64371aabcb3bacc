#pragma once

#include "haptics/surface/facet_part.h"
#include "haptics/surface/shape_field.h"
#include "haptics/surface/tree/box_tree.h"
#include "haptics/surface/tree/facet_sums.h"
#include "haptics/surface/winding.h"

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

namespace palp
{

/// Immutable triangle surface with all that the contact search needs, built off the servo thread.
class Surface
{
public:
  /// Checks the triangles, computes normals and neighbors, builds the box tree.
  ///
  /// Degenerate triangles and points without a triangle are allowed and ignored by the search. Of a
  /// closed surface that crosses itself, or whose pieces overlap, triangles with the inside or the
  /// outside on both sides become degenerate: they bound nothing.
  ///
  /// @param points     [m]
  /// @param triangles  indices into points, outward oriented
  /// @throws Error     BadMesh: no triangle, an index out of range, a coordinate not finite
  Surface(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles);

  [[nodiscard]] std::span<const Eigen::Vector3d> points() const noexcept
  {
    return points_;
  }
  [[nodiscard]] std::span<const Triangle> triangles() const noexcept
  {
    return triangles_;
  }

  /// Angle-weighted unit normals of the points; zero where a point has no triangle.
  ///
  /// This weight, and no other, tells inside from outside at a corner.
  /// @source Baerentzen and Aanaes, IEEE TVCG 11(3), 2005
  [[nodiscard]] std::span<const Eigen::Vector3d> normals() const noexcept
  {
    return normals_;
  }

  /// Points that share an edge with a point.
  [[nodiscard]] std::span<const int> neighbors(int point) const noexcept;

  /// Triangle across the edge from corner k to corner k + 1; -1 where there is none, or no one.
  [[nodiscard]] int across(int triangle, int k) const noexcept
  {
    return across_[static_cast<std::size_t>(triangle)][static_cast<std::size_t>(k)];
  }

  /// The one triangle of a point that stands for it; -1 where a point has none with an area.
  [[nodiscard]] int firstTriangle(int point) const noexcept
  {
    return firstTriangle_[static_cast<std::size_t>(point)];
  }

  /// True when every edge has two triangles, or is gone along as often one way as the other, as
  /// where bodies touch: what is inside is known.
  [[nodiscard]] bool closed() const noexcept
  {
    return isClosed_;
  }

  /// Whether a point ends an edge that has not exactly two triangles.
  [[nodiscard]] bool onOpenEdge(int point) const noexcept;

  /// A place where a closed surface crosses itself, or its pieces overlap; none: it does so
  /// nowhere, or is open.
  [[nodiscard]] const std::optional<Eigen::Vector3d>& crossing() const noexcept
  {
    return crossing_;
  }

  /// Of a surface with a crossing(); none of any other, where the nearest triangle tells inside
  /// from outside at a tenth of the cost.
  [[nodiscard]] const std::optional<Winding>& winding() const noexcept
  {
    return winding_;
  }

  /// Distance to the nearest open edge; infinity where the surface is closed.
  ///
  /// @param position  near the triangle [m]
  /// @return          [m], exact up to the choice of the edge among those nearest to the corners
  /// @realtime        pure; no allocation, no lock, no exception
  [[nodiscard]] double edgeDistance(const Eigen::Vector3d& position, int triangle) const noexcept;

  /// Curvature, thickness and edges, averaged over a contact.
  [[nodiscard]] const ShapeField& shape() const noexcept
  {
    return shape_;
  }

  /// Root mean square of the edge lengths [m], the scale below which the mesh knows nothing.
  [[nodiscard]] double edgeLength() const noexcept
  {
    return edgeLength_;
  }

  /// The same of triangles that stand for what is round [m]: at a side of which it turns by more
  /// than half a degree, but for ridges; 0: none, its faces are flat however they are cut.
  [[nodiscard]] double facetLength() const noexcept
  {
    return creases_.facetLength;
  }

  [[nodiscard]] const BoxTree& tree() const noexcept
  {
    return tree_;
  }

  /// What the triangles below the nodes of the tree add up to.
  [[nodiscard]] const FacetSums& sums() const noexcept
  {
    return sums_;
  }

private:
  bool linkEdges();
  [[nodiscard]] std::vector<std::uint8_t> openSides() const;
  void spreadOpenEdges();
  [[nodiscard]] std::optional<Eigen::Vector3d> findOverlap() const;
  void dropWhatIsBuried();

  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<int> firstNeighbor_; // CSR, #points + 1
  std::vector<int> neighbors_;
  std::vector<int> firstTriangle_;
  std::vector<std::array<int, 3>> across_;
  std::vector<std::array<int, 2>> openEdges_;
  std::vector<int> nearestOpenEdge_; // per point, empty when closed
  bool isClosed_ = false;
  double edgeLength_ = 0.0;
  Creases creases_;
  BoxTree tree_;
  FacetSums sums_;
  ShapeField shape_;
  std::optional<Eigen::Vector3d> crossing_;
  std::optional<Winding> winding_;
};

} // namespace palp
