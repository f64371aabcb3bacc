#include "app/bench/bench.h"
#include "app/program/data_files.h"
#include "haptics/servo/scene.h"
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

} // namespace

std::vector<BenchRow> benchLaw()
{
  const ForceLaw paper = Scene{}.law;
  const Material& tissue = paper.material();
  const LawSettings everything{ .mode = LawMode::Corrected,
    .largeStrain = readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv")) };
  LawSettings coated = everything;
  coated.coatings.add({ 2.0_mm, { 4.0 * tissue.youngModulus, tissue.poissonRatio } });
  return { benchOne("", paper), benchOne("cone", ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, tissue)),
    benchOne("exact", ForceLaw(paper.tip(), tissue, { .mode = LawMode::Exact })),
    benchOne("corrected", ForceLaw(paper.tip(), tissue, everything)),
    benchOne("paraboloid", ForceLaw(ParaboloidTip{ 10.0_mm }, tissue, everything)),
    benchOne("coated", ForceLaw(paper.tip(), tissue, coated)) };
}

} // namespace palp
