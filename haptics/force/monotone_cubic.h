#pragma once

#include <span>
#include <vector>

namespace palp
{

struct Cubic
{
  double value;
  double slope;
};

/// Cubic on one interval from the values and slopes at its ends.
///
/// @param place  0 to 1 along the interval
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] constexpr Cubic hermite(
  double place, double width, double y0, double y1, double slope0, double slope1) noexcept
{
  const double chord = (y1 - y0) / width;
  const double bend = slope0 + slope1 - 2.0 * chord;
  const double turn = chord - slope0 - bend;
  return { y0 + width * place * (slope0 + place * (turn + place * bend)),
    slope0 + place * (2.0 * turn + 3.0 * place * bend) };
}

/// Slopes at points of a smooth curve, of the polynomial through the nearest five points.
///
/// @param x  at least 2, increasing
/// @param y  as many
[[nodiscard]] std::vector<double> polynomialSlopes(
  std::span<const double> x, std::span<const double> y);

/// The same, limited so that the cubics through the points run as monotonically as the points do.
/// @source Fritsch and Carlson 1980
[[nodiscard]] std::vector<double> monotoneSlopes(
  std::span<const double> x, std::span<const double> y);

} // namespace palp
