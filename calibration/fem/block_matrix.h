#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace palp::fem
{

/// A symmetric matrix of 3 x 3 blocks, one for each node and one for each edge of tetrahedra.
///
/// Blocks above the diagonal are stored, row by row. That of an edge holds d2W/dx_i dx_j, i < j.
/// Of our own, for Eigen's sparse matrices store no blocks.
class BlockMatrix
{
public:
  BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets);

  struct Edge
  {
    int i;
    int j; ///< more than i
  };
  [[nodiscard]] const std::vector<Edge>& edges() const noexcept
  {
    return edges_;
  }

  /// Of a tetrahedron whose nodes ascend: 01, 02, 03, 12, 13, 23, as indices into edges().
  [[nodiscard]] std::array<int, 6> edgesOf(const std::array<int, 4>& nodes) const;

  /// One per edge.
  [[nodiscard]] std::vector<Eigen::Matrix3d>& blocks() noexcept
  {
    return blocks_;
  }
  [[nodiscard]] const std::vector<Eigen::Matrix3d>& diagonal() const noexcept
  {
    return diagonal_;
  }

  /// Fills the diagonal so that shifting all nodes alike takes no force.
  void balance();

  /// The product with the values at all nodes.
  void multiply(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& product) const;

private:
  [[nodiscard]] int edgeBetween(int i, int j) const;

  std::vector<int> rows_; // first edge of each node
  std::vector<Edge> edges_;
  std::vector<Eigen::Matrix3d> blocks_;
  std::vector<Eigen::Matrix3d> diagonal_;
};

} // namespace palp::fem
