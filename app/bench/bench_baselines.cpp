#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "calibration/baselines/stepper.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kNodes = 40; // along each side: the paper's 1,600 vertices
constexpr std::size_t kPoints = std::size_t{ kNodes } * kNodes;
constexpr int kLayers = 10;         // of nodes
constexpr double kHeight = 50.0_mm; // the block of Sec. 3.3.2
constexpr double kStep = 10.0_ms;
constexpr int kSteps = 50;
constexpr int kRepetitions = 1000; // of ours, which are a thousand times shorter

BenchRow benchBaseline(fem::Baseline baseline)
{
  const Scene scene; // the tool and tissue of ours
  fem::Stepper stepper(fem::blockTets(kBenchSide, kHeight, kNodes, kLayers), baseline,
    scene.law.tip(), scene.law.material());
  // straight down at the start of the circle, then along it
  const Eigen::Vector3d start = benchPose(0.0).apex;
  for (int i = 0; i <= 20; ++i)
  {
    stepper.placeTool({ start.x(), start.y(), i / 20.0 * start.z() });
    (void)stepper.step(kStep);
  }
  std::vector<Eigen::Vector3d> circle;
  for (int i = 1; i <= kSteps; ++i)
  {
    circle.push_back(benchPose(kStep * i).apex);
  }
  std::vector<double> times = timeSteps(stepper, circle, kStep).milliseconds;
  for (double& time : times)
  {
    time *= 1e3;
  }
  BenchRow row = benchRow("baseline", kPoints, "moving", std::move(times));
  row.variant = name(baseline);
  return row;
}

} // namespace

std::vector<BenchRow> benchBaselines()
{
  const Mesh mesh = makeGrid(kNodes, kBenchSide);
  ServoTick tick(std::make_shared<const Surface>(mesh.points, mesh.triangles));
  VisualUpdate update(kNodes);
  const auto nothing = [](int) {};
  const auto pose = [](int i) { return benchPose(kStep * (i % kSteps)); };
  const auto servo = [&](int i) { (void)tick(pose(i)); };
  const auto picture = [&](int i) { update(pose(i)); };
  (void)timed(kRepetitions, nothing, servo); // soft start
  std::vector<BenchRow> rows{ benchRow("servo_step", kPoints, "moving",
                                timed(kRepetitions, nothing, servo)),
    benchRow("update", kPoints, "moving", timed(kRepetitions, nothing, picture)) };
  for (const fem::Baseline baseline : fem::kBaselines)
  {
    rows.push_back(benchBaseline(baseline));
  }
  return rows;
}

} // namespace palp
