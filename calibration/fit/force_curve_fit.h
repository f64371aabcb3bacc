#pragma once

#include "haptics/numerics/roots.h"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace palp::fit
{

/// What was measured: a force at each depth.
struct Measured
{
  Eigen::VectorXd depths; ///< [m], from any zero
  Eigen::VectorXd forces; ///< [N], as many
};

/// F = scale shape(depth - contact, extra) + offset; offset alone before the contact.
struct CurveModel
{
  /// F / scale at a depth of more than 0 [m], and the extra value.
  std::function<double(double depth, double extra)> shape;
  RootBracket extra{ 0.0, 0.0 };   ///< searched in it; of no width: known
  std::optional<double> contact{}; ///< depth at which the tool touches [m]; none: searched
  std::optional<double> offset{};  ///< force before the contact [N]; none: searched

  [[nodiscard]] bool searchesExtra() const noexcept
  {
    return extra.high > extra.low;
  }

  /// Numbers that are searched.
  [[nodiscard]] int parameters() const noexcept
  {
    return 1 + (contact ? 0 : 1) + (offset ? 0 : 1) + (searchesExtra() ? 1 : 0);
  }
};

/// A number with the ends of its interval, which are infinite where the curve does not tell them.
struct Estimate
{
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// The curve of least squares.
struct CurveFit
{
  Estimate scale;
  Estimate contact; ///< [m]; of no width where it is held
  Estimate extra;
  double offset = 0.0;       ///< [N]
  double sumOfSquares = 0.0; ///< of the residuals [N^2]
  Eigen::VectorXd forces;    ///< of the curve [N]
};

inline constexpr double kConfidence = 0.95; ///< of every interval

/// Least squares by variable projection: scale and offset, in which the force is linear, are
/// solved for at each contact and extra value, and only those two are searched, from a grid.
///
/// The intervals are those of the profile likelihood: an end is where the sum of squares, lowest
/// over all other numbers, has grown by t^2 / (rows - parameters) of itself, t being Student's.
/// So what is not known of contact, offset and extra value is part of the scale's interval, and
/// no interval is taken as symmetric. They hold for independent normal errors of one size in the
/// forces, and exact depths.
///
/// @param measured  more rows than parameters
/// @throws Error    BadValue: too few rows, or the force does not rise with the depth
/// @source          Golub and Pereyra 1973 (projection); Bates and Watts 1988, Sec. 6.1 (profiles)
[[nodiscard]] CurveFit fitForceCurve(const Measured& measured, const CurveModel& model);

} // namespace palp::fit
