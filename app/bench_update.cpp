#include "app/bench.h"
#include "app/bench_work.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kFrames = 1000;

BenchRow benchSurface(int n)
{
  VisualUpdate update(n);
  // 2 mm from frame to frame
  const auto frame = [&](int i) { update(benchPose(20.0_ms * i)); };
  for (int i = 0; i < 20; ++i)
  {
    frame(i);
  }
  const auto vertices = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  return benchRow("update", vertices, "moving",
    timed(
      kFrames, [](int) {}, frame));
}

} // namespace

std::vector<BenchRow> benchUpdate(std::size_t most)
{
  std::vector<BenchRow> rows;
  for (const int n : { 40, 50, 60, 70, 80, 90, 100 })
  {
    if (static_cast<std::size_t>(n) * static_cast<std::size_t>(n) <= most)
    {
      rows.push_back(benchSurface(n));
    }
  }
  return rows;
}

} // namespace palp
