#include "app/bench/bench.h"

#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace palp
{
namespace
{

// noinline and the empty asm keep the loop scalar and alive whatever the flags
[[gnu::noinline]] double sweep(std::span<const double> points, double radius, double depth)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    const double x = points[i] - 0.5;
    const double y = points[i + 1] - 0.5;
    const double z = points[i + 2] - 0.5;
    const double r = std::sqrt(x * x + y * y + z * z);
    if (r < radius)
    {
      const double t = 1.0 - (r / radius) * (r / radius);
      sum += depth * t * t;
    }
    asm volatile("" : "+x"(sum));
  }
  return sum;
}

} // namespace

BenchRow benchRow(
  std::string work, std::size_t vertices, std::string mode, std::vector<double> microseconds)
{
  const Statistics times = statisticsOf(std::move(microseconds));
  return { .work = std::move(work),
    .vertices = vertices,
    .mode = std::move(mode),
    .median = times.median,
    .mean = times.mean,
    .deviation = times.deviation,
    .p99 = times.p99 };
}

double benchSweep()
{
  std::vector<double> points(30'000);
  std::uint32_t state = 12345;
  for (double& value : points)
  {
    state = state * 1664525U + 1013904223U;
    value = (state >> 8U) / 16777216.0;
  }
  double sink = 0.0;
  std::vector<double> microseconds = timed(
    101, [](int) {}, [&](int) { sink += sweep(points, 0.3, 0.01); });
  return benchRow("sweep", 10'000, sink > 0.0 ? "warm" : "", std::move(microseconds)).median;
}

} // namespace palp
