#include "haptics/force/linear/punch_solution.h"

#include "haptics/numerics/monotone_cubic.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palp
{
namespace
{

Eigen::Map<const Eigen::VectorXd> vectorOf(const std::vector<double>& values)
{
  return { values.data(), static_cast<Eigen::Index>(values.size()) };
}

} // namespace

PunchEquation::PunchEquation(Quadrature wavenumbers, int nodes)
  : wavenumbers_(std::move(wavenumbers))
  , nodes_(gaussLegendre(nodes, 0.0, 1.0))
{
  const auto x = vectorOf(nodes_.nodes).array();
  Eigen::MatrixXd powers(nodes, PunchSolution::kTerms);
  for (int k = 0; k < PunchSolution::kTerms; ++k)
  {
    powers.col(k) = x.pow(2 * k);
  }
  const Eigen::MatrixXd weighted = powers.transpose() * vectorOf(nodes_.weights).asDiagonal();
  fit_ = (weighted * powers).ldlt().solve(weighted);
}

void PunchEquation::setRadius(double radius)
{
  radius_ = radius;
  cosines_ =
    (radius * vectorOf(nodes_.nodes) * vectorOf(wavenumbers_.nodes).transpose()).array().cos();
}

Eigen::MatrixXd PunchEquation::kernel(const Eigen::VectorXd& deficit) const
{
  const Eigen::VectorXd spectrum = vectorOf(wavenumbers_.weights).cwiseProduct(deficit);
  // deep below the surface nothing is felt of short waves
  constexpr double unfelt = 1e-14;
  const auto felt = std::find_if(
    deficit.begin(), deficit.end(), [](double fraction) { return std::abs(fraction) > unfelt; });
  const Eigen::Index count = deficit.end() - felt;
  const auto cosines = cosines_.rightCols(count);
  return 2.0 * radius_ / std::numbers::pi * cosines * spectrum.tail(count).asDiagonal() *
    cosines.transpose() * vectorOf(nodes_.weights).asDiagonal();
}

Eigen::VectorXd PunchEquation::phi(const Eigen::MatrixXd& kernel) const
{
  const Eigen::Index nodes = kernel.rows();
  return (Eigen::MatrixXd::Identity(nodes, nodes) - kernel)
    .partialPivLu()
    .solve(Eigen::VectorXd::Ones(nodes));
}

std::array<double, PunchSolution::kTerms> PunchEquation::solve(const Eigen::MatrixXd& kernel) const
{
  const Eigen::VectorXd terms = fit_ * phi(kernel);
  std::array<double, PunchSolution::kTerms> result{};
  std::copy(terms.begin(), terms.end(), result.begin());
  return result;
}

void setSlopes(std::span<PunchSolution> solutions, std::size_t series, double step)
{
  std::vector<double> widths(solutions.size() / series);
  std::vector<double> values(widths.size());
  for (std::size_t k = 0; k < PunchSolution::kTerms; ++k)
  {
    for (std::size_t one = 0; one < series; ++one)
    {
      for (std::size_t row = 0; row < widths.size(); ++row)
      {
        widths[row] = static_cast<double>(row) * step;
        values[row] = solutions[row * series + one].value[k];
      }
      const std::vector<double> slopes = polynomialSlopes(widths, values);
      for (std::size_t row = 0; row < widths.size(); ++row)
      {
        solutions[row * series + one].slope[k] = slopes[row];
      }
    }
  }
}

PunchSolution between(
  const PunchSolution& low, const PunchSolution& high, double step, double fraction) noexcept
{
  PunchSolution result;
  for (std::size_t k = 0; k < PunchSolution::kTerms; ++k)
  {
    const Cubic cubic =
      hermite(fraction, step, low.value[k], high.value[k], low.slope[k], high.slope[k]);
    result.value[k] = cubic.value;
    result.slope[k] = cubic.slope;
  }
  return result;
}

} // namespace palp
