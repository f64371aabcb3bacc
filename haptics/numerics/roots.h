#pragma once

#include <algorithm>
#include <cmath>

namespace palp
{

// Of our own: they run in the servo thread, where a library's may allocate or throw.

/// Where something changes: it is still so at low, and no longer at high.
struct RootBracket
{
  double low;
  double high;
};

/// Halves a bracket.
///
/// @param holds     of a number in the bracket; true at low, false at high
/// @param halvings  each gains a factor of two; 60 exhaust a double
/// @realtime        as holds
template <typename Holds>
[[nodiscard]] RootBracket bisect(const Holds& holds, RootBracket bracket, int halvings) noexcept
{
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = 0.5 * (bracket.low + bracket.high);
    (holds(middle) ? bracket.low : bracket.high) = middle;
  }
  return bracket;
}

/// Root of a function by false position with the Illinois rule: as safe as halving, and as fast as
/// secants.
///
/// @param atLow      its value at low, less than 0
/// @param atHigh     its value at high, more than 0
/// @param tolerance  width of the bracket at which to stop
/// @return           around the root; of no width where the function was 0
/// @source           Dowell and Jarratt 1971
/// @realtime         as function
template <typename Function>
[[nodiscard]] RootBracket falsePosition(const Function& function, RootBracket bracket, double atLow,
  double atHigh, double tolerance, int mostSteps) noexcept
{
  auto& [low, high] = bracket;
  for (int i = 0; i < mostSteps && high - low > tolerance; ++i)
  {
    const double middle = std::clamp((low * atHigh - high * atLow) / (atHigh - atLow), low, high);
    const double value = function(middle);
    if (value == 0.0)
    {
      return { middle, middle };
    }
    (value < 0.0 ? low : high) = middle;
    (value < 0.0 ? atLow : atHigh) = value;
    (value < 0.0 ? atHigh : atLow) *= 0.5;
  }
  return bracket;
}

/// Newton's method where it is known to converge from the given start.
///
/// @param stepAt  value over slope at a number
/// @return        to about 1e-18 of itself, since the error of a step is the square of the one
///                before
/// @realtime      as stepAt
template <typename Function>
[[nodiscard]] double newton(double x, const Function& stepAt) noexcept
{
  constexpr int kMaxSteps = 20; // three to five are usual
  for (int i = 0; i < kMaxSteps; ++i)
  {
    const double step = stepAt(x);
    x -= step;
    if (!(std::abs(step) > 1e-9 * std::abs(x)))
    {
      break;
    }
  }
  return x;
}

/// Newton's method within a bracket, which is halved where a step leaves it.
///
/// @param at  value and slope at a number; the value is below 0 at low and above 0 at high
/// @return    with the last step, which is less than the tolerance, or after 40
/// @realtime  as at
template <typename At>
[[nodiscard]] double boundedNewton(
  double x, RootBracket bracket, double tolerance, const At& at) noexcept
{
  constexpr int kMaxSteps = 40; // three are usual
  for (int i = 0; i < kMaxSteps; ++i)
  {
    const auto [value, slope] = at(x);
    const double last = x;
    (value > 0.0 ? bracket.high : bracket.low) = last;
    x = last - value / slope;
    if (!(x >= bracket.low && x <= bracket.high))
    {
      x = 0.5 * (bracket.low + bracket.high);
    }
    if (std::abs(x - last) < tolerance)
    {
      break;
    }
  }
  return x;
}

} // namespace palp
