#pragma once

#include <algorithm>

namespace palp
{

/// From 0 at t = 0 to 1 at t = 1, level at both ends and constant beyond them.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr double smoothStep(double t) noexcept
{
  const double within = std::clamp(t, 0.0, 1.0);
  return within * within * (3.0 - 2.0 * within);
}

/// A value of a function with its slope there.
struct Sloped
{
  double value;
  double slope = 0.0; ///< by what the function is of
};

/// The larger of two, with the corner between them rounded off: up to a quarter of the width above,
/// where they differ by less than the width, and exact elsewhere.
///
/// @param width  above 0
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] constexpr Sloped smoothMax(const Sloped& a, const Sloped& b, double width) noexcept
{
  const Sloped& larger = a.value > b.value ? a : b;
  const Sloped& smaller = a.value > b.value ? b : a;
  const double near = width - (larger.value - smaller.value);
  if (!(near > 0.0))
  {
    return larger;
  }
  const double part = near / (2.0 * width);
  return { larger.value + 0.5 * near * part, larger.slope + part * (smaller.slope - larger.slope) };
}

/// The smaller of two, likewise, and up to a quarter of the width below.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] constexpr Sloped smoothMin(const Sloped& a, const Sloped& b, double width) noexcept
{
  const Sloped most = smoothMax({ -a.value, -a.slope }, { -b.value, -b.slope }, width);
  return { -most.value, -most.slope };
}

/// Of values alone.
[[nodiscard]] constexpr double smoothMin(double a, double b, double width) noexcept
{
  return smoothMin(Sloped{ a }, Sloped{ b }, width).value;
}

} // namespace palp
