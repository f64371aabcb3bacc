#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "data/shapes.h"
#include "haptics/contact/ball/disc_integral.h"
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
constexpr double kBall = 10.0_mm;

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

// as an organ file of cells of 4 mm tells of a body
Scene organOn(const Mesh& mesh)
{
  constexpr double kSpacing = 5.0_mm;
  std::vector<PlacedCompliance> places;
  const int count = static_cast<int>(kBenchSide / kSpacing);
  for (int i = 0; i < count * count; ++i)
  {
    PlacedCompliance& place = places.emplace_back();
    place.position = { kSpacing * (i % count) - 0.5 * kBenchSide,
      kSpacing * (i / count) - 0.5 * kBenchSide, mesh.points.front().z() };
    place.constant = 50.0;
    place.slope = { 300.0, 0.0, 0.0 };
    place.bend = -2e4;
  }
  Scene scene;
  scene.series = seriesBodyOf(
    std::make_shared<const ComplianceField>(places, kSpacing, scene.law.material().poissonRatio),
    scene.law);
  return scene;
}

// round and round, after a soft start in the air and a way down that no limit holds back
BenchRow benchMoving(ServoTick& tick, std::size_t vertices, int ticks, const char* variant)
{
  const auto move = [&](int i) { (void)tick(poseAtTick(i)); };
  for (int i = 0; i < kSoftStart; ++i)
  {
    ToolPose above = poseAtTick(i);
    above.apex.z() += kBenchDepth * (4.0 - 4.0 * i / kSoftStart);
    (void)tick(above);
  }
  BenchRow row = benchRow("servo_step", vertices, "moving",
    timed(
      ticks, [](int) {}, move));
  row.variant = variant;
  return row;
}

void benchSurface(
  int n, int ticks, const Scene& tissue, CacheFlush& flush, std::vector<BenchRow>& rows)
{
  const Mesh mesh = makeGrid(n, kBenchSide);
  const std::size_t vertices = mesh.points.size();
  rows.push_back(benchRow("tree_build", vertices, "cold",
    timed(
      3, [](int) {}, [&](int) { const BoxTree tree(mesh.points, mesh.triangles); })));

  const auto surface = std::make_shared<const Surface>(mesh.points, mesh.triangles);
  ServoTick tick(surface);
  rows.push_back(benchMoving(tick, vertices, ticks, ""));
  ServoTick onOrgan(surface, organOn(mesh));
  rows.push_back(benchMoving(onOrgan, vertices, ticks, "organ"));
  DeviceLimits wrist = benchDevice();
  wrist.maxTorque = 0.2;            // [N m]
  wrist.maxAngularStiffness = 0.25; // [N m/rad]
  ServoTick turning(surface, {}, wrist);
  rows.push_back(benchMoving(turning, vertices, ticks, "torque"));
  ServoTick inTissue(surface, tissue);
  rows.push_back(benchMoving(inTissue, vertices, ticks, "nodules, relaxation, friction"));

  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-35.0_mm, 35.0_mm);
  ToolPose pose = poseAtTick(0);
  const auto jump = [&](int) {
    pose.apex = { coordinate(random), coordinate(random), -kBenchDepth };
  };
  rows.push_back(
    benchRow("servo_step", vertices, "jump", timed(ticks, jump, [&](int) { (void)tick(pose); })));
  const auto move = [&](int i) { (void)tick(poseAtTick(i)); };
  rows.push_back(benchRow("servo_step", vertices, "cold", timed(ticks / 40, flush, move)));

  auto due = std::chrono::steady_clock::now();
  const auto wait = [&](int)
  { std::this_thread::sleep_until(due += std::chrono::milliseconds(1)); };
  rows.push_back(benchRow("servo_step", vertices, "paced", timed(ticks / 4, wait, move)));

  // the same integrals over all triangles
  double weight = 0.0;
  const auto all = [&](int i)
  {
    const Eigen::Vector3d center = poseAtTick(i).apex + kBall * Eigen::Vector3d::UnitZ();
    RimAngle rim(kBall);
    for (const Facet& facet : surface->tree().facets())
    {
      weight += integrate(facet, center, kBall * kBall, rim).weight;
    }
  };
  const int repetitions = std::min(vertices > 20'000 ? 20 : 200, ticks / 20);
  rows.push_back(benchRow("query_brute", vertices, "moving",
    timed(
      repetitions, [](int) {}, all)));
}

} // namespace

std::vector<BenchRow> benchServo(std::size_t most, int ticks)
{
  std::vector<BenchRow> rows = benchLaw();
  const Scene tissue = benchTissue(true);
  CacheFlush flush;
  for (const int n : { 40, 50, 60, 70, 80, 90, 100, 316, 1000 })
  {
    if (static_cast<std::size_t>(n) * static_cast<std::size_t>(n) <= most)
    {
      benchSurface(n, ticks, tissue, flush, rows);
    }
  }
  return rows;
}

} // namespace palp
