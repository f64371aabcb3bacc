#pragma once

#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace palp
{

/// Where a function of one number is lowest, and its value there.
struct Minimum
{
  double at;
  double value;
};

/// The lowest point within a bracket: the parabola through three points, or the golden section
/// where that does not help.
///
/// @param function   with one minimum in the bracket; of several, one is found
/// @param start      in the bracket, with its value
/// @param tolerance  how near to the minimum, more than 0
/// @source           Brent 1973, Algorithms for Minimization without Derivatives, Ch. 5
template <typename Function>
[[nodiscard]] Minimum minimize(
  const Function& function, RootBracket bracket, Minimum start, double tolerance)
{
  constexpr double kGolden = 0.3819660112501051; // (3 - sqrt(5)) / 2
  constexpr int kMostSteps = 100;
  Minimum best = start;
  Minimum second = start;
  Minimum third = start;
  double step = 0.0;
  double before = 0.0; // the step before the last
  for (int i = 0; i < kMostSteps; ++i)
  {
    const double middle = 0.5 * (bracket.low + bracket.high);
    if (std::abs(best.at - middle) + 0.5 * (bracket.high - bracket.low) <= 2.0 * tolerance)
    {
      break;
    }
    const double r = (best.at - second.at) * (best.value - third.value);
    const double q = (best.at - third.at) * (best.value - second.value);
    const double p = (best.at - third.at) * q - (best.at - second.at) * r;
    const double parabola = -p / (2.0 * (q - r));
    const bool holds = std::abs(parabola) < 0.5 * std::abs(before) &&
      best.at + parabola > bracket.low && best.at + parabola < bracket.high;
    before = holds ? step : (best.at < middle ? bracket.high : bracket.low) - best.at;
    step = holds ? parabola : kGolden * before;
    if (std::abs(step) < tolerance)
    {
      step = best.at < middle ? tolerance : -tolerance;
    }
    const Minimum next{ best.at + step, function(best.at + step) };
    const bool lower = next.value <= best.value;
    (lower == (next.at >= best.at) ? bracket.low : bracket.high) = lower ? best.at : next.at;
    if (lower)
    {
      third = std::exchange(second, std::exchange(best, next));
    }
    else if (next.value <= second.value || second.at == best.at)
    {
      third = std::exchange(second, next);
    }
    else if (next.value <= third.value || third.at == best.at || third.at == second.at)
    {
      third = next;
    }
  }
  return best;
}

/// The same from where a function is lowest of several numbers, between its neighbors there.
/// @param at  increasing, at least one
template <typename Function>
[[nodiscard]] Minimum minimizeAmong(
  const Function& function, std::span<const double> at, double tolerance)
{
  std::size_t lowest = 0;
  double value = function(at[0]);
  for (std::size_t i = 1; i < at.size(); ++i)
  {
    if (const double other = function(at[i]); other < value)
    {
      lowest = i;
      value = other;
    }
  }
  const RootBracket around{ at[lowest - std::min<std::size_t>(lowest, 1)],
    at[std::min(lowest + 1, at.size() - 1)] };
  return minimize(function, around, { at[lowest], value }, tolerance);
}

} // namespace palp
