#include "haptics/numerics/monotone_cubic.h"

#include <algorithm>
#include <cmath>

namespace palp
{

Bracket bracket(std::span<const double> axis, double value) noexcept
{
  if (axis.size() < 2)
  {
    return { 0, 0.0 };
  }
  const double x = std::clamp(value, axis.front(), axis.back());
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
  const auto low = static_cast<std::size_t>(above - axis.begin()) - 1;
  return { low, (x - axis[low]) / (axis[low + 1] - axis[low]) };
}

Cubic cubicAt(std::span<const double> x, std::span<const double> y, std::span<const double> slopes,
  double at) noexcept
{
  const auto [low, fraction] = bracket(x, at);
  return hermite(fraction, x[low + 1] - x[low], y[low], y[low + 1], slopes[low], slopes[low + 1]);
}

std::vector<double> polynomialSlopes(std::span<const double> x, std::span<const double> y)
{
  const std::size_t count = x.size();
  const std::size_t width = std::min<std::size_t>(count, 5);
  std::vector<double> slopes(count, 0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t begin =
      std::min(i > width / 2 ? i - width / 2 : std::size_t{ 0 }, count - width);
    for (std::size_t j = begin; j < begin + width; ++j)
    {
      if (j == i)
      {
        continue;
      }
      // derivative at x[i] of Lagrange's polynomial j, applied to y[j] - y[i]
      double weight = 1.0 / (x[j] - x[i]);
      for (std::size_t k = begin; k < begin + width; ++k)
      {
        weight *= k != j && k != i ? (x[i] - x[k]) / (x[j] - x[k]) : 1.0;
      }
      slopes[i] += weight * (y[j] - y[i]);
    }
  }
  return slopes;
}

std::vector<double> monotoneSlopes(std::span<const double> x, std::span<const double> y)
{
  std::vector<double> slopes = polynomialSlopes(x, y);
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  for (std::size_t i = 0; i < slopes.size(); ++i)
  {
    const double before = chord(i > 0 ? i - 1 : 0);
    const double after = chord(i + 1 < slopes.size() ? i : i - 1);
    const double steepest = 3.0 * std::min(std::abs(before), std::abs(after));
    const double low = before < 0.0 && after < 0.0 ? -steepest : 0.0;
    const double high = before > 0.0 && after > 0.0 ? steepest : 0.0;
    slopes[i] = std::clamp(slopes[i], low, high);
  }
  return slopes;
}

} // namespace palp
