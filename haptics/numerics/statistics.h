#pragma once

#include <vector>

namespace palp
{

/// What repeated measurements of one figure say, in its unit.
struct Statistics
{
  double median = 0.0; ///< the upper one of an even number
  double mean = 0.0;
  double deviation = 0.0; ///< standard deviation of the values themselves
  double low = 0.0;
  double high = 0.0;
  double p99 = 0.0; ///< the value below which 99 % lie
};

/// @param values  at least one, in any order; finite
[[nodiscard]] Statistics statisticsOf(std::vector<double> values);

} // namespace palp
