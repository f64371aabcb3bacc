#include "pipeline/charts/curve_reading.h"

#include "pipeline/view/appearance.h"

#include <algorithm>
#include <cmath>

namespace palp
{

std::optional<double> valueOfLine(
  std::span<const double> x, std::span<const double> y, double at, double wanted)
{
  std::optional<double> nearest;
  for (std::size_t i = 1; i < x.size(); ++i)
  {
    if (at < std::min(x[i - 1], x[i]) || at > std::max(x[i - 1], x[i]))
    {
      continue;
    }
    // of a piece that is upright, the nearest of all its values
    const double value = x[i] == x[i - 1]
      ? std::clamp(wanted, std::min(y[i - 1], y[i]), std::max(y[i - 1], y[i]))
      : std::lerp(y[i - 1], y[i], (at - x[i - 1]) / (x[i] - x[i - 1]));
    if (!nearest || std::abs(value - wanted) < std::abs(*nearest - wanted))
    {
      nearest = value;
    }
  }
  return nearest;
}

std::string readingText(double value, double step)
{
  constexpr double kMost = 9.0;
  const double decimals = std::clamp(std::ceil(-std::log10(step)), 0.0, kMost);
  return appearance::fixedText(value, static_cast<int>(decimals));
}

std::string unitOf(const std::string& title)
{
  const std::size_t open = title.rfind('[');
  const std::size_t close = title.rfind(']');
  return open < close && close != title.npos ? title.substr(open + 1, close - open - 1)
                                             : std::string{};
}

} // namespace palp
