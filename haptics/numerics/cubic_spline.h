#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace palp
{

/// An axis of equal steps.
struct SplineAxis
{
  double first;
  double last;
  int intervals; ///< 4 or more

  [[nodiscard]] constexpr double step() const noexcept
  {
    return (last - first) / intervals;
  }
};

/// The cubic B-splines that are not 0 at a place, and their derivatives there.
struct SplineBasis
{
  static constexpr std::size_t kPieces = 4;
  using Pieces = std::array<double, kPieces>;

  std::size_t low; ///< index of the first one's coefficient
  Pieces value;
  Pieces slope;
  Pieces bend; ///< second derivative
};

/// @param at   beyond the axis, its border
/// @realtime   pure; no allocation, no lock, no exception
[[nodiscard]] SplineBasis splineBasis(const SplineAxis& axis, double at) noexcept;

/// The coefficients of the twice continuously differentiable spline through values at equal steps;
/// the slopes at the ends are those of the polynomials through the nearest five values.
///
/// @param values  5 or more
/// @return        two more than values
[[nodiscard]] std::vector<double> splineCoefficients(std::span<const double> values);

/// Twice continuously differentiable curve through values at equal steps.
class CubicSpline
{
public:
  struct Value
  {
    double value;
    double slope;
    double bend; ///< second derivative
  };

  /// @param values  one more than the axis has intervals
  CubicSpline(const SplineAxis& axis, std::span<const double> values);

  /// @param at   beyond the axis, its border
  /// @realtime   pure; no allocation, no lock, no exception
  [[nodiscard]] Value operator()(double at) const noexcept
  {
    const double along = std::clamp((at - first_) * perStep_, 0.0, last_);
    const auto piece = static_cast<std::size_t>(std::min(along, last_ - 1.0));
    const double t = along - static_cast<double>(piece);
    const auto& [a, b, c, d] = pieces_[piece];
    return { a + t * (b + t * (c + t * d)), (b + t * (2.0 * c + t * 3.0 * d)) * perStep_,
      (2.0 * c + 6.0 * t * d) * (perStep_ * perStep_) };
  }

private:
  double first_;
  double last_; // in steps, as many as there are
  double perStep_;
  std::vector<std::array<double, 4>> pieces_; // as powers of what is past a step, in steps
};

/// Twice continuously differentiable surface through values on a grid of equal steps.
class BicubicSpline
{
public:
  struct Value
  {
    double value = 0.0;
    double x = 0.0;  ///< d/dx
    double y = 0.0;  ///< d/dy
    double yy = 0.0; ///< d2/dy2
  };

  /// @param values  at each x, those of all y
  BicubicSpline(const SplineAxis& x, const SplineAxis& y, std::span<const double> values);

  /// @param x   beyond its axis, the border; as y
  /// @realtime  pure; no allocation, no lock, no exception
  [[nodiscard]] Value operator()(double x, double y) const noexcept
  {
    return (*this)(splineBasis(x_, x), splineBasis(y_, y));
  }

  /// The same where one of both is asked for often: by what of each axis is not 0 there.
  [[nodiscard]] Value operator()(const SplineBasis& x, const SplineBasis& y) const noexcept;

private:
  SplineAxis x_;
  SplineAxis y_;
  std::vector<double> coefficients_; // of each x, y running fastest
};

} // namespace palp
