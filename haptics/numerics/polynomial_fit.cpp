#include "haptics/numerics/polynomial_fit.h"

#include <Eigen/QR>
#include <cmath>

namespace palp
{

double PolynomialFit::operator()(double x) const noexcept
{
  double y = 0.0;
  for (std::size_t k = coefficients.size(); k-- > 0;)
  {
    y = y * x + coefficients[k];
  }
  return y;
}

PolynomialFit fitPolynomial(std::span<const double> x, std::span<const double> y, int degree)
{
  PolynomialFit fit;
  const auto count = static_cast<Eigen::Index>(x.size());
  if (count <= degree)
  {
    return fit;
  }
  Eigen::MatrixXd powers(count, degree + 1);
  powers.col(0).setOnes();
  const auto at = Eigen::Map<const Eigen::VectorXd>(x.data(), count);
  const auto values = Eigen::Map<const Eigen::VectorXd>(y.data(), count);
  for (int p = 1; p <= degree; ++p)
  {
    powers.col(p) = powers.col(p - 1).cwiseProduct(at);
  }
  const Eigen::VectorXd solution = powers.colPivHouseholderQr().solve(values);
  const Eigen::VectorXd residual = powers * solution - values;
  fit.coefficients.assign(solution.begin(), solution.end());
  fit.rms = residual.norm() / std::sqrt(static_cast<double>(count));
  fit.worst = residual.lpNorm<Eigen::Infinity>();
  fit.upTo = x.back();
  return fit;
}

} // namespace palp
