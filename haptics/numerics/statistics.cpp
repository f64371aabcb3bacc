#include "haptics/numerics/statistics.h"

#include "haptics/numerics/roots.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unsupported/Eigen/SpecialFunctions>

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

double studentQuantile(double probability, double freedom)
{
  constexpr int kHalvings = 60;
  // x of the incomplete beta function falls from 1 as t grows from 0
  const auto isBeyond = [&](double x)
  { return Eigen::numext::betainc(0.5 * freedom, 0.5, x) < 1.0 - probability; };
  const double x = bisect(isBeyond, { 0.0, 1.0 }, kHalvings).low;
  return std::sqrt(freedom * (1.0 - x) / x);
}

} // namespace palp
