#pragma once

#include "haptics/numerics/polynomial_fit.h"

#include <vector>

namespace palp::fem
{

/// R_d over depth: a line for small depths and a parabola for all.
/// @source Fig. 8: linear to about 7 mm, quadratic beyond
struct ExtentFits
{
  PolynomialFit linear;       ///< over the depths to which it holds; empty below four
  PolynomialFit quadratic;    ///< over all depths
  double linearHoldsTo = 0.0; ///< every residual up to there below 3 % of the largest radius
};

/// Rows where nothing sinks by the threshold (radius 0) are left out.
[[nodiscard]] ExtentFits fitExtent(
  const std::vector<double>& depths, const std::vector<double>& extents);

} // namespace palp::fem
