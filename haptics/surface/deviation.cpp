#include "haptics/surface/deviation.h"

#include "haptics/surface/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp
{

Deviation deviation(const Surface& a, const Surface& b)
{
  double largest = 0.0;
  double sum = 0.0;
  std::size_t count = 0;
  const auto measure = [&](const Surface& from, const Surface& to)
  {
    for (std::size_t i = 0; i < from.points().size(); ++i)
    {
      if (from.firstTriangle(static_cast<int>(i)) < 0)
      {
        continue;
      }
      const double distance =
        findClosestPoint(to, from.points()[i], std::numeric_limits<double>::infinity()).distance;
      largest = std::max(largest, std::abs(distance));
      sum += distance * distance;
      ++count;
    }
  };
  measure(a, b);
  measure(b, a);
  return { .largest = largest, .rootMeanSquare = std::sqrt(sum / static_cast<double>(count)) };
}

} // namespace palp
