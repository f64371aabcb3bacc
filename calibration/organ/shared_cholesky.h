#pragma once

#include "haptics/error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

namespace palp
{

/// Eigen's factors of CHOLMOD, but for solutions by several threads at once.
class SharedCholesky
  : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double, Eigen::ColMajor, int>>
{
public:
  using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  /// @throws Error  NoSolution: out of memory
  [[nodiscard]] Eigen::MatrixXd solveAll(const Eigen::MatrixXd& right) const
  {
    cholmod_common own; // NOLINT(cppcoreguidelines-pro-type-member-init): by the next line
    cholmod_start(&own);
    own.print = 0;
    cholmod_dense known = Eigen::viewAsCholmod(right.const_cast_derived());
    cholmod_dense* found = cholmod_solve(CHOLMOD_A, m_cholmodFactor, &known, &own);
    Eigen::MatrixXd solution;
    if (found != nullptr)
    {
      solution =
        Eigen::Map<Eigen::MatrixXd>(static_cast<double*>(found->x), right.rows(), right.cols());
      cholmod_free_dense(&found, &own);
    }
    cholmod_finish(&own);
    if (solution.size() != right.size())
    {
      throw Error(ErrorCode::NoSolution, "too little memory for the loads; give larger cells");
    }
    return solution;
  }
};

} // namespace palp
