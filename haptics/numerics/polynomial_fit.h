#pragma once

#include <span>
#include <vector>

namespace palp
{

/// A polynomial and how well it fits; residuals in the unit of the values.
struct PolynomialFit
{
  std::vector<double> coefficients{}; ///< lowest power first
  double rms = 0.0;
  double worst = 0.0; ///< largest residual, without sign
  double upTo = 0.0;  ///< the last argument that was fitted

  /// Its value; 0 of an empty fit.
  [[nodiscard]] double operator()(double x) const noexcept;
};

/// Least squares.
/// @param y       as many as x
/// @param degree  less than the number of points; with too few points the fit is empty
[[nodiscard]] PolynomialFit fitPolynomial(
  std::span<const double> x, std::span<const double> y, int degree);

} // namespace palp
