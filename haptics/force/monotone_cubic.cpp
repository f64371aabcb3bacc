#include "haptics/force/monotone_cubic.h"

#include <algorithm>
#include <cmath>

namespace palp
{

std::vector<double> monotoneSlopes(std::span<const double> x, std::span<const double> y)
{
  // slope at x[i] of the polynomial through the nearest five points
  const std::size_t count = x.size();
  const std::size_t width = std::min<std::size_t>(count, 5);
  const auto slopeAt = [&](std::size_t i)
  {
    const std::size_t begin =
      std::min(i > width / 2 ? i - width / 2 : std::size_t{ 0 }, count - width);
    double slope = 0.0;
    for (std::size_t j = begin; j < begin + width; ++j)
    {
      // derivative of Lagrange's polynomial j at x[i], on y[j] - y[i] so that constants vanish
      double weight = 1.0;
      for (std::size_t k = begin; k < begin + width; ++k)
      {
        if (k != j && k != i)
        {
          weight *= (x[i] - x[k]) / (x[j] - x[k]);
        }
      }
      slope += j == i ? 0.0 : weight * (y[j] - y[i]) / (x[j] - x[i]);
    }
    return slope;
  };

  std::vector<double> slopes(count);
  const auto chord = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double before = chord(i > 0 ? i - 1 : 0);
    const double after = chord(i + 1 < count ? i : count - 2);
    const double limit =
      before * after > 0.0 ? 3.0 * std::min(std::abs(before), std::abs(after)) : 0.0;
    slopes[i] =
      before > 0.0 ? std::clamp(slopeAt(i), 0.0, limit) : std::clamp(slopeAt(i), -limit, 0.0);
  }
  return slopes;
}

} // namespace palp
