#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace palp
{

using Triangle = std::array<int, 3>; ///< point indices, counter-clockwise from outside

/// Immutable triangle surface with all that the contact search needs, built off the servo thread.
class Surface
{
public:
  /// Checks the triangles, computes normals and neighbours, builds the box tree.
  ///
  /// Degenerate triangles and points without a triangle are allowed and ignored by the search.
  ///
  /// @param points     [m]
  /// @param triangles  indices into points, outward oriented
  /// @throws Error     BadMesh: no triangle, an index out of range, a coordinate not finite
  Surface(std::vector<Eigen::Vector3d> points, std::vector<Triangle> triangles);

  [[nodiscard]] std::span<const Eigen::Vector3d> points() const noexcept { return points_; }
  [[nodiscard]] std::span<const Triangle> triangles() const noexcept { return triangles_; }

  /// Area-weighted unit normals of the points; zero where a point has no triangle.
  [[nodiscard]] std::span<const Eigen::Vector3d> normals() const noexcept { return normals_; }

  /// Points that share an edge with a point.
  [[nodiscard]] std::span<const int> neighbours(int point) const noexcept;

  /// True when every edge has exactly two triangles.
  [[nodiscard]] bool closed() const noexcept { return closed_; }

private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<int> firstNeighbour_; // CSR, #points + 1
  std::vector<int> neighbours_;
  bool closed_ = false;
};

} // namespace palp
