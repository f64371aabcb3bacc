#include "haptics/force/layer.h"

#include "haptics/force/monotone_cubic.h"
#include "haptics/force/quadrature.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace palp
{
namespace
{

constexpr int kRows = 61;                              // from half-space to the widest contact
constexpr double kStep = Layer::kWidest / (kRows - 1); // in a / thickness
constexpr double kDeepest = 20.0;                      // 1 - L falls as exp(-2 y), to 1e-15 here

// 1 - L(y) of the layer's kernel, scaled by exp(-2 y) so that nothing overflows
double deficit(double y, double nu, Base base)
{
  const double e = std::exp(-2.0 * y);
  if (base == Base::Slip)
  {
    return 1.0 - (1.0 - e) * (1.0 - e) / (1.0 - e * e + 4.0 * y * e);
  }
  const double k = 3.0 - 4.0 * nu;
  return 1.0 -
    (k * (1.0 - e * e) - 4.0 * y * e) / (k * (1.0 + e * e) + (1.0 + k * k + 4.0 * y * y) * e);
}

} // namespace

Layer::Layer(double poissonRatio, Base base)
  : rows_(kRows)
{
  const Quadrature y = gaussLegendre(80, 0.0, kDeepest);
  const Quadrature x = gaussLegendre(16, 0.0, 1.0);
  const auto waves = static_cast<Eigen::Index>(y.nodes.size());
  const auto places = static_cast<Eigen::Index>(x.nodes.size());
  const auto at = [](const std::vector<double>& values, Eigen::Index i)
  { return values[static_cast<std::size_t>(i)]; };

  Eigen::VectorXd spectrum(waves);
  for (Eigen::Index q = 0; q < waves; ++q)
  {
    spectrum[q] = at(y.weights, q) * deficit(at(y.nodes, q), poissonRatio, base);
  }
  const Eigen::VectorXd weights = Eigen::Map<const Eigen::VectorXd>(x.weights.data(), places);
  Eigen::MatrixXd powers(places, kTerms);
  for (Eigen::Index i = 0; i < places; ++i)
  {
    for (int k = 0; k < kTerms; ++k)
    {
      powers(i, k) = std::pow(at(x.nodes, i), 2 * k);
    }
  }
  // least squares in even powers keeps the integrals of phi and of x^2 phi exact
  const Eigen::MatrixXd fit =
    (powers.transpose() * weights.asDiagonal() * powers).ldlt().solve(powers.transpose());

  for (int row = 0; row < kRows; ++row)
  {
    const double width = row * kStep;
    Eigen::MatrixXd cosines(places, waves);
    for (Eigen::Index i = 0; i < places; ++i)
    {
      for (Eigen::Index q = 0; q < waves; ++q)
      {
        cosines(i, q) = std::cos(width * at(x.nodes, i) * at(y.nodes, q));
      }
    }
    const Eigen::MatrixXd kernel = 2.0 * width / std::numbers::pi * cosines *
      spectrum.asDiagonal() * cosines.transpose() * weights.asDiagonal();
    const Eigen::VectorXd phi = (Eigen::MatrixXd::Identity(places, places) - kernel)
                                  .partialPivLu()
                                  .solve(Eigen::VectorXd::Ones(places));
    const Eigen::VectorXd terms = fit * weights.cwiseProduct(phi);
    std::copy(terms.begin(), terms.end(), rows_[static_cast<std::size_t>(row)].value.begin());
  }

  std::vector<double> widths(kRows);
  std::vector<double> values(kRows);
  for (std::size_t k = 0; k < kTerms; ++k)
  {
    for (std::size_t row = 0; row < kRows; ++row)
    {
      widths[row] = static_cast<double>(row) * kStep;
      values[row] = rows_[row].value[k];
    }
    const std::vector<double> slopes = polynomialSlopes(widths, values);
    for (std::size_t row = 0; row < kRows; ++row)
    {
      rows_[row].slope[k] = slopes[row];
    }
  }
}

Layer::Terms Layer::operator()(double width) const noexcept
{
  if (width >= kWidest)
  {
    Terms terms = rows_.back();
    for (std::size_t k = 0; k < kTerms; ++k)
    {
      terms.value[k] += terms.slope[k] * (width - kWidest);
    }
    return terms;
  }
  const double along = width / kStep;
  const std::size_t i = std::min(static_cast<std::size_t>(along), rows_.size() - 2);
  const Terms& low = rows_[i];
  const Terms& high = rows_[i + 1];
  Terms terms;
  for (std::size_t k = 0; k < kTerms; ++k)
  {
    const Cubic cubic = hermite(along - static_cast<double>(i), kStep, low.value[k], high.value[k],
      low.slope[k], high.slope[k]);
    terms.value[k] = cubic.value;
    terms.slope[k] = cubic.slope;
  }
  return terms;
}

} // namespace palp
