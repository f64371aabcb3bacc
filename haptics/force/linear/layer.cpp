#include "haptics/force/linear/layer.h"

#include <algorithm>
#include <cmath>

namespace palp
{
namespace
{

constexpr int kRows = 61;                              // from half-space to the widest contact
constexpr double kStep = Layer::kWidest / (kRows - 1); // in a / thickness
constexpr double kMaxDepth = 20.0;                     // 1 - L falls as exp(-2 y), to 1e-15 here

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

// of each row, which are the same for every material, and most of the work
const std::vector<PunchEquation>& equations()
{
  static const std::vector<PunchEquation> all = []
  {
    std::vector<PunchEquation> rows(kRows, PunchEquation(gaussLegendre(80, 0.0, kMaxDepth), 16));
    for (int row = 0; row < kRows; ++row)
    {
      rows[static_cast<std::size_t>(row)].setRadius(row * kStep);
    }
    return rows;
  }();
  return all;
}

} // namespace

Layer::Layer(double poissonRatio, Base base)
  : rows_(kRows)
{
  const std::vector<double>& y = equations().front().wavenumbers();
  Eigen::VectorXd deficits(static_cast<Eigen::Index>(y.size()));
  std::transform(y.begin(), y.end(), deficits.begin(),
    [&](double at) { return deficit(at, poissonRatio, base); });
  for (std::size_t row = 0; row < rows_.size(); ++row)
  {
    const PunchEquation& equation = equations()[row];
    rows_[row].value = equation.solve(equation.kernel(deficits));
  }
  setSlopes(rows_, 1, kStep);
}

PunchSolution Layer::operator()(double width) const noexcept
{
  if (width == 0.0)
  {
    return rows_.front(); // as without end
  }
  if (width < kWidest)
  {
    const double along = width / kStep;
    const auto i = std::min(static_cast<std::size_t>(along), rows_.size() - 2);
    return between(rows_[i], rows_[i + 1], kStep, along - static_cast<double>(i));
  }
  PunchSolution solution = rows_.back();
  for (std::size_t k = 0; k < PunchSolution::kTerms; ++k)
  {
    solution.value[k] += solution.slope[k] * (width - kWidest);
  }
  return solution;
}

} // namespace palp
