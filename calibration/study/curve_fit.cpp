#include "calibration/study/curve_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace palp::fem
{

Fit fitPolynomial(const std::vector<double>& x, const std::vector<double>& y, int degree)
{
  Fit fit;
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

ExtentFits fitExtent(const std::vector<double>& depths, const std::vector<double>& extents)
{
  constexpr double kHolds = 0.03;    // residual to the largest radius
  constexpr std::size_t kFewest = 4; // points through which a line says something
  std::vector<double> x;
  std::vector<double> y;
  ExtentFits fits;
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    if (extents[i] <= 0.0)
    {
      continue;
    }
    x.push_back(depths[i]);
    y.push_back(extents[i]);
    const Fit line = fitPolynomial(x, y, 1);
    if (x.size() >= kFewest && line.worst <= kHolds * *std::max_element(y.begin(), y.end()))
    {
      fits.linear = line;
      fits.linearHoldsTo = depths[i];
    }
  }
  fits.quadratic = fitPolynomial(x, y, 2);
  return fits;
}

} // namespace palp::fem
