#pragma once

#include <vector>

namespace palp::fem
{

/// Least squares of a polynomial; residuals in the unit of the values.
struct Fit
{
  std::vector<double> coefficients{}; ///< lowest power first
  double rms = 0.0;
  double worst = 0.0; ///< largest residual, without sign
  double upTo = 0.0;  ///< the last argument that was fitted
};

/// @param degree  less than the number of points; with too few points the fit is empty
[[nodiscard]] Fit fitPolynomial(
  const std::vector<double>& x, const std::vector<double>& y, int degree);

/// R_d over depth: a line for small depths and a parabola for all.
/// @source Fig. 8: linear to about 7 mm, quadratic beyond
struct ExtentFits
{
  Fit linear;                 ///< over the depths to which it holds; empty below four
  Fit quadratic;              ///< over all depths
  double linearHoldsTo = 0.0; ///< every residual up to there below 3 % of the largest radius
};

/// Rows where nothing sinks by the threshold (radius 0) are left out.
[[nodiscard]] ExtentFits fitExtent(
  const std::vector<double>& depths, const std::vector<double>& extents);

} // namespace palp::fem
