#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "haptics/servo/scene.h"
#include "haptics/servo/tissue_memory.h"
#include "haptics/units.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kCalls = 1000; // per measurement, for one is shorter than the clock's grain

BenchRow benchOne(const char* variant, const ForceLaw& law)
{
  double sum = 0.0;
  std::vector<double> times = timed(
    1000, [](int) {},
    [&](int i)
    {
      for (int k = 0; k < kCalls; ++k)
      {
        sum += law({ .depth = 5.0_mm + 1e-9 * (i + k),
                     .tilt = 5.0_deg,
                     .thickness = 30.0_mm,
                     .surfaceCurvature = 1.0 / 50.0_mm,
                     .curvatureSpread = 1.0 / 200.0_mm })
                 .force;
      }
    });
  for (double& time : times)
  {
    time /= kCalls;
  }
  BenchRow row = benchRow("law", 0, sum > 0.0 ? "moving" : "", std::move(times));
  row.variant = variant;
  return row;
}

// what a tick of tissue that relaxes and rubs takes above one that does not
BenchRow benchMemory(const char* variant)
{
  const Scene scene = benchTissue(*variant != '\0');
  TissueMemory memory;
  Sample sample;
  sample.contact = { .depth = 5.0_mm,
    .normal = Eigen::Vector3d::UnitZ(),
    .surfaceCurvature = 1.0 / 50.0_mm,
    .thickness = 30.0_mm };
  double sum = 0.0;
  std::vector<double> times = timed(
    1000, [](int) {},
    [&](int)
    {
      sample.pose.apex.x() += 0.1_mm;
      sample.contact.center.x() += 0.1_mm;
      (void)memory.begin(scene, sample, 1.0_ms);
      const Response at = memory.at(sample.contact.depth);
      const Rendered felt{ at.force, at.stiffness, sample.contact.depth };
      sum += memory.settle(felt, 1e6, sample).x();
    });
  BenchRow row = benchRow("memory", 0, sum < 0.0 ? "moving" : "", std::move(times));
  row.variant = variant;
  return row;
}

} // namespace

std::vector<BenchRow> benchLaw()
{
  const ForceLaw paper = Scene{}.law;
  const Material& tissue = paper.material();
  const LawSettings everything = benchSettings();
  LawSettings coated = everything;
  coated.coatings.add({ 2.0_mm, { 4.0 * tissue.youngModulus, tissue.poissonRatio } });
  return { benchOne("", paper), benchOne("cone", ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, tissue)),
    benchOne("exact", ForceLaw(paper.tip(), tissue, { .mode = LawMode::Exact })),
    benchOne("corrected", ForceLaw(paper.tip(), tissue, everything)),
    benchOne("paraboloid", ForceLaw(ParaboloidTip{ 10.0_mm }, tissue, everything)),
    benchOne("coated", ForceLaw(paper.tip(), tissue, coated)), benchMemory(""),
    benchMemory("nodules") };
}

} // namespace palp
