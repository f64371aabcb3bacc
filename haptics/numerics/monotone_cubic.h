#pragma once

#include <cstddef>
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
/// @param fraction  0 to 1 along the interval
/// @realtime     pure; no allocation, no lock, no exception
[[nodiscard]] constexpr Cubic hermite(
  double fraction, double width, double y0, double y1, double slope0, double slope1) noexcept
{
  const double chord = (y1 - y0) / width;
  const double bend = slope0 + slope1 - 2.0 * chord;
  const double turn = chord - slope0 - bend;
  return { y0 + width * fraction * (slope0 + fraction * (turn + fraction * bend)),
    slope0 + fraction * (2.0 * turn + 3.0 * fraction * bend) };
}

/// An interval of an axis.
struct Bracket
{
  std::size_t low; ///< its first point
  double fraction; ///< 0 to 1, towards the next point
};

/// The interval that holds a value; beyond the axis, its border.
///
/// @param axis  increasing; of one value alone it is { 0, 0 }
/// @realtime    pure; no allocation, no lock, no exception
[[nodiscard]] Bracket bracket(std::span<const double> axis, double value) noexcept;

/// The curve of cubics through points; beyond them, the border.
///
/// @param x       2 or more, increasing
/// @param y       as many
/// @param slopes  dy/dx, as many
/// @realtime      pure; no allocation, no lock, no exception
[[nodiscard]] Cubic cubicAt(std::span<const double> x, std::span<const double> y,
  std::span<const double> slopes, double at) noexcept;

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
