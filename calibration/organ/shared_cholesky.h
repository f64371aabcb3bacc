#pragma once

#include "haptics/error.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>
#include <cmath>
#include <cstddef>
#include <string>
#include <unistd.h>

namespace palp
{

/// Eigen's factors of CHOLMOD, but for solutions by several threads at once.
class SharedCholesky
  : public Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double, Eigen::ColMajor, int>>
{
public:
  using Sparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  /// The factors of a body of n nodes take about n^(4/3) times a kilobyte: 0.7 and 2.1 GB of 22,000
  /// and 49,000 nodes of a liver.
  /// @throws Error  BadValue: more than the machine has
  static void checkMemory(std::size_t nodes)
  {
    constexpr double kFactors = 1.2e3; // [B]
    constexpr double kGigabyte = 1e9;
    const double needed = kFactors * std::pow(static_cast<double>(nodes), 4.0 / 3.0);
    const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (needed > there)
    {
      throw Error(ErrorCode::BadValue,
        "the cells are too small for this machine: they take about " +
          std::to_string(std::lround(needed / kGigabyte)) + " GB of memory, and it has " +
          std::to_string(std::lround(there / kGigabyte)) + "; give larger ones");
    }
  }

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
