#include "haptics/numerics/cubic_spline.h"

#include "haptics/numerics/monotone_cubic.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{
namespace
{

constexpr std::size_t kPieces = SplineBasis::kPieces;

std::size_t coefficientsOn(const SplineAxis& axis) noexcept
{
  return static_cast<std::size_t>(axis.intervals) + 3;
}

double sum(const double* coefficients, const SplineBasis::Pieces& pieces) noexcept
{
  return coefficients[0] * pieces[0] + coefficients[1] * pieces[1] + coefficients[2] * pieces[2] +
    coefficients[3] * pieces[3];
}

} // namespace

SplineBasis splineBasis(const SplineAxis& axis, double at) noexcept
{
  constexpr double kSixth = 1.0 / 6.0;
  const double last = axis.intervals;
  const double toSlope = last / (axis.last - axis.first);
  const double along = std::clamp((at - axis.first) * toSlope, 0.0, last);
  const double low = std::min(static_cast<double>(static_cast<int>(along)), last - 1.0);
  const double t = along - low;
  const double s = 1.0 - t;
  const double toBend = toSlope * toSlope;
  return { .low = static_cast<std::size_t>(low),
    .value = { kSixth * s * s * s, kSixth * (3.0 * t * t * t - 6.0 * t * t + 4.0),
      kSixth * (3.0 * s * s * s - 6.0 * s * s + 4.0), kSixth * t * t * t },
    .slope = { -0.5 * s * s * toSlope, (1.5 * t * t - 2.0 * t) * toSlope,
      (2.0 * s - 1.5 * s * s) * toSlope, 0.5 * t * t * toSlope },
    .bend = { s * toBend, (3.0 * t - 2.0) * toBend, (3.0 * s - 2.0) * toBend, t * toBend } };
}

std::vector<double> splineCoefficients(std::span<const double> values)
{
  const std::size_t count = values.size();
  std::vector<double> positions(count);
  std::iota(positions.begin(), positions.end(), 0.0);
  const std::vector<double> slopes = polynomialSlopes(positions, values);

  // Thomas's elimination: c[i-1] + 4 c[i] + c[i+1] = 6 value, and at the ends, with the slope
  // (c[i+1] - c[i-1]) / 2, 2 c[0] + c[1] = 3 value + slope and its mirror image
  std::vector<double> c(count + 2);
  std::vector<double> next(count, 0.5);
  c[1] = 0.5 * (3.0 * values[0] + slopes[0]);
  for (std::size_t i = 1; i < count; ++i)
  {
    const bool end = i + 1 == count;
    const double right = end ? 3.0 * values[i] - slopes[i] : 6.0 * values[i];
    next[i] = 1.0 / ((end ? 2.0 : 4.0) - next[i - 1]);
    c[i + 1] = (right - c[i]) * next[i];
  }
  for (std::size_t i = count - 1; i > 0; --i)
  {
    c[i] -= next[i - 1] * c[i + 1];
  }
  c[0] = c[2] - 2.0 * slopes[0];
  c[count + 1] = c[count - 1] + 2.0 * slopes[count - 1];
  return c;
}

CubicSpline::CubicSpline(const SplineAxis& axis, std::span<const double> values)
  : first_(axis.first)
  , last_(axis.intervals)
  , perStep_(1.0 / axis.step())
{
  const std::vector<double> c = splineCoefficients(values);
  for (std::size_t i = 0; i + 3 < c.size(); ++i)
  {
    pieces_.push_back({ (c[i] + 4.0 * c[i + 1] + c[i + 2]) / 6.0, 0.5 * (c[i + 2] - c[i]),
      0.5 * (c[i] - 2.0 * c[i + 1] + c[i + 2]),
      (c[i + 3] - 3.0 * c[i + 2] + 3.0 * c[i + 1] - c[i]) / 6.0 });
  }
}

BicubicSpline::BicubicSpline(
  const SplineAxis& x, const SplineAxis& y, std::span<const double> values)
  : x_(x)
  , y_(y)
  , coefficients_(coefficientsOn(x) * coefficientsOn(y))
{
  const auto rows = static_cast<std::size_t>(x.intervals) + 1;
  const auto columns = static_cast<std::size_t>(y.intervals) + 1;
  std::vector<std::vector<double>> along;
  for (std::size_t row = 0; row < rows; ++row)
  {
    along.push_back(splineCoefficients(values.subspan(row * columns, columns)));
  }
  std::vector<double> across(rows);
  for (std::size_t column = 0; column < columns + 2; ++column)
  {
    std::transform(along.begin(), along.end(), across.begin(),
      [&](const std::vector<double>& row) { return row[column]; });
    const std::vector<double> c = splineCoefficients(across);
    for (std::size_t row = 0; row < c.size(); ++row)
    {
      coefficients_[row * (columns + 2) + column] = c[row];
    }
  }
}

BicubicSpline::Value BicubicSpline::operator()(
  const SplineBasis& x, const SplineBasis& y) const noexcept
{
  Eigen::Array4d across = Eigen::Array4d::Zero(); // the curve over y at x
  Eigen::Array4d change = Eigen::Array4d::Zero(); // and how it changes with x
  for (std::size_t i = 0; i < kPieces; ++i)
  {
    const Eigen::Map<const Eigen::Array4d> row(
      coefficients_.data() + (x.low + i) * coefficientsOn(y_) + y.low);
    across += x.value[i] * row;
    change += x.slope[i] * row;
  }
  return { sum(across.data(), y.value), sum(change.data(), y.value), sum(across.data(), y.slope),
    sum(across.data(), y.bend) };
}

} // namespace palp
