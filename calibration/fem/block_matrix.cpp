#include "calibration/fem/block_matrix.h"

#include <algorithm>

namespace palp::fem
{

BlockMatrix::BlockMatrix(int nodes, const std::vector<std::array<int, 4>>& tets)
{
  const auto size = static_cast<std::size_t>(nodes);
  std::vector<std::vector<int>> larger(size);
  for (const auto& tet : tets)
  {
    for (const int i : tet)
    {
      for (const int j : tet)
      {
        if (i < j)
        {
          larger[static_cast<std::size_t>(i)].push_back(j);
        }
      }
    }
  }
  rows_.push_back(0);
  for (int i = 0; i < nodes; ++i)
  {
    std::vector<int>& row = larger[static_cast<std::size_t>(i)];
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    for (const int j : row)
    {
      edges_.push_back({ i, j });
    }
    rows_.push_back(static_cast<int>(edges_.size()));
  }
  blocks_.assign(edges_.size(), Eigen::Matrix3d::Zero());
  diagonal_.assign(size, Eigen::Matrix3d::Zero());
}

int BlockMatrix::edgeBetween(int i, int j) const
{
  const auto row = static_cast<std::size_t>(i);
  const auto edge = std::lower_bound(edges_.begin() + rows_[row], edges_.begin() + rows_[row + 1],
    j, [](const Edge& e, int to) { return e.j < to; });
  return static_cast<int>(edge - edges_.begin());
}

std::array<int, 6> BlockMatrix::edgesOf(const std::array<int, 4>& nodes) const
{
  const auto [a, b, c, d] = nodes;
  return { edgeBetween(a, b), edgeBetween(a, c), edgeBetween(a, d), edgeBetween(b, c),
    edgeBetween(b, d), edgeBetween(c, d) };
}

void BlockMatrix::balance()
{
  std::fill(diagonal_.begin(), diagonal_.end(), Eigen::Matrix3d::Zero());
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    diagonal_[static_cast<std::size_t>(edges_[e].i)] -= blocks_[e];
    diagonal_[static_cast<std::size_t>(edges_[e].j)] -= blocks_[e].transpose();
  }
}

void BlockMatrix::multiply(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& product) const
{
  product.setZero();
  std::size_t e = 0;
  for (std::size_t i = 0; i < diagonal_.size(); ++i)
  {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d here = x.col(row);
    Eigen::Vector3d sum = diagonal_[i] * here;
    for (const auto end = static_cast<std::size_t>(rows_[i + 1]); e < end; ++e)
    {
      sum.noalias() += blocks_[e] * x.col(edges_[e].j);
      product.col(edges_[e].j).noalias() += blocks_[e].transpose() * here;
    }
    product.col(row) += sum;
  }
}

} // namespace palp::fem
