#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palp
{

Statistics statisticsOf(std::vector<double> values)
{
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values)
  {
    squares += (value - mean) * (value - mean);
  }
  return { .median = values[values.size() / 2],
    .mean = mean,
    .deviation = std::sqrt(squares / count),
    .low = values.front(),
    .high = values.back(),
    .p99 = values[static_cast<std::size_t>(0.99 * (count - 1.0))] };
}

} // namespace palp
