#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "data/shapes.h"
#include "haptics/contact/patch.h"
#include "haptics/units.h"

#include <algorithm>
#include <random>
#include <thread>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kSoftStart = 4000; // ticks

ToolPose poseAtTick(int tick)
{
  return benchPose(1.0_ms * tick);
}

// walks over more memory than the caches hold
class CacheFlush
{
public:
  void operator()(int)
  {
    for (std::size_t i = 0; i < bytes_.size(); i += 64)
    {
      bytes_[i] = static_cast<char>(bytes_[i] + 1);
    }
  }

private:
  std::vector<char> bytes_ = std::vector<char>(64UL << 20U);
};

void benchSurface(int n, int ticks, CacheFlush& flush, std::vector<BenchRow>& rows)
{
  const Mesh mesh = makeGrid(n, kBenchSide);
  const std::size_t vertices = mesh.points.size();
  rows.push_back(benchRow("tree_build", vertices, "cold",
    timed(
      3, [](int) {}, [&](int) { const BoxTree tree(mesh.points, mesh.triangles); })));

  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  ServoTick tick(surface);
  const auto nothing = [](int) {};
  const auto move = [&](int i) { (void)tick(poseAtTick(i)); };
  for (int i = 0; i < kSoftStart; ++i)
  {
    move(i);
  }
  rows.push_back(benchRow("servo_step", vertices, "moving", timed(ticks, nothing, move)));

  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-35.0_mm, 35.0_mm);
  ToolPose pose = poseAtTick(0);
  const auto jump = [&](int) {
    pose.apex = { coordinate(random), coordinate(random), -kBenchDepth };
  };
  rows.push_back(
    benchRow("servo_step", vertices, "jump", timed(ticks, jump, [&](int) { (void)tick(pose); })));
  rows.push_back(benchRow("servo_step", vertices, "cold", timed(ticks / 40, flush, move)));

  auto due = std::chrono::steady_clock::now();
  const auto wait = [&](int)
  { std::this_thread::sleep_until(due += std::chrono::milliseconds(1)); };
  rows.push_back(benchRow("servo_step", vertices, "paced", timed(ticks / 4, wait, move)));

  // the same integrals over all triangles
  double weight = 0.0;
  const auto all = [&](int i)
  {
    const Eigen::Vector3d center = poseAtTick(i).apex + 10.0_mm * Eigen::Vector3d::UnitZ();
    for (const Facet& facet : surface->tree().facets())
    {
      weight += integrate(facet, center, 1e-4).weight;
    }
  };
  const int repetitions = std::min(vertices > 20'000 ? 20 : 200, ticks / 20);
  rows.push_back(benchRow("query_brute", vertices, "moving", timed(repetitions, nothing, all)));
}

} // namespace

std::vector<BenchRow> benchServo(std::size_t most, int ticks)
{
  std::vector<BenchRow> rows = benchLaw();
  CacheFlush flush;
  for (const int n : { 40, 50, 60, 70, 80, 90, 100, 316, 1000 })
  {
    if (static_cast<std::size_t>(n) * static_cast<std::size_t>(n) <= most)
    {
      benchSurface(n, ticks, flush, rows);
    }
  }
  return rows;
}

} // namespace palp
