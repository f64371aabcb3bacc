#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "data/shapes.h"
#include "haptics/contact/patch.h"
#include "haptics/servo/servo.h"
#include "haptics/units.h"

#include <algorithm>
#include <ostream>
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

class CircleDevice final : public Device
{
public:
  [[nodiscard]] DeviceLimits limits() const override
  {
    return benchDevice();
  }

  [[nodiscard]] std::optional<ToolPose> exchange(const Eigen::Vector3d&, double) noexcept override
  {
    return poseAtTick(tick_++);
  }

private:
  int tick_ = 0;
};

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

void runServo(const std::function<bool(double)>& watch,
  const std::function<void(const Timing&, const std::string&, double)>& finished)
{
  const Mesh mesh = makeGrid(100, kBenchSide);
  Scene scene;
  scene.surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  scene.armed = true;
  CircleDevice device;
  Servo servo(device, scene);
  while (watch(servo.newest().time))
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  finished(servo.timing(), servo.schedule(), servo.newest().time);
}

void reportServo(std::ostream& out, std::chrono::duration<double> duration)
{
  const auto line = [&](const char* name, const Histogram& histogram)
  {
    const auto us = [](Histogram::Duration time)
    { return std::chrono::duration<double, std::micro>(time).count(); };
    out << name << " [us]: p50 " << us(histogram.quantile(0.5)) << ", p99 "
        << us(histogram.quantile(0.99)) << ", p99.9 " << us(histogram.quantile(0.999)) << ", max "
        << us(histogram.longest()) << '\n';
  };
  runServo([&](double elapsed) { return elapsed < duration.count(); },
    [&](const Timing& timing, const std::string& schedule, double elapsed)
    {
      out << "servo thread: " << schedule << '\n';
      line("lateness", timing.lateness);
      line("step", timing.step);
      const std::uint64_t ticks = timing.ticks;
      const std::uint64_t skipped = timing.skipped;
      out << "ticks " << ticks << " + skipped " << skipped << " in " << elapsed << " s\n";
    });
}

} // namespace palp
