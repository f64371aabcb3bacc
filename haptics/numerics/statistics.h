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

/// What the size of Student's t stays below with a probability.
/// @param probability  more than 0, less than 1
/// @param freedom      degrees of freedom, 1 or more
/// @source             Abramowitz and Stegun 1964, 26.7.1: 1 - I_x(freedom / 2, 1 / 2) with
///                     x = freedom / (freedom + t^2)
[[nodiscard]] double studentQuantile(double probability, double freedom);

} // namespace palp
