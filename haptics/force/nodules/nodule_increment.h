#pragma once

#include "haptics/force/nodules/homogeneous_press.h"
#include "haptics/force/nodules/nodule.h"

#include <vector>

namespace palp
{

/// The force with a nodule over that without one, less 1, from the increment of first order and
/// back: what it makes of several increments x is their sum.
///
/// x / (1 - 0.51 x), bounded where x is no longer small: to 0.9 as in the fit, and as far below.
/// @source  Eshelby 1957 to first order; higher orders: fitted to linear finite elements
namespace increment
{

constexpr double kHigherOrders = 0.51;

/// A value with its first and second derivative.
struct Series
{
  double value;
  double slope;
  double bend;
};

/// @param x   increment of first order [-]
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr Series ofFirstOrder(double x) noexcept
{
  const double rest = 1.0 / (1.0 - kHigherOrders * x);
  return { x * rest, rest * rest, 2.0 * kHigherOrders * rest * rest * rest };
}

/// Its inverse.
[[nodiscard]] constexpr Series toFirstOrder(double increment) noexcept
{
  const double rest = 1.0 / (1.0 + kHigherOrders * increment);
  return { increment * rest, rest * rest, -2.0 * kHigherOrders * rest * rest * rest };
}

/// The same number up to `from`, above it smoothly less than `to`; below 0 the mirror image.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] Series bounded(double x, double from, double to) noexcept;

/// That of a nodule alone: bounded where the fit of higher orders ends.
[[nodiscard]] double ofNodule(double x) noexcept;

} // namespace increment

/// Increments of first order at the knots of a press: how much more energy the tissue takes where
/// the nodule stands in it, its own strain being uniform as Eshelby's, with what the free surface
/// and the tool change of it.
///
/// @param nodule   checked
/// @param lateral  from the tool's axis to the nodule's [m], 0 or more
/// @return         x, one for each knot [-]
[[nodiscard]] std::vector<double> firstOrderIncrements(
  const HomogeneousPress& press, const Nodule& nodule, double lateral);

} // namespace palp
