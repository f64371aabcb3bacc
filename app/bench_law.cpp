#include "app/bench.h"
#include "app/data_files.h"
#include "haptics/servo/scene.h"
#include "haptics/units.h"

namespace palp
{
namespace
{

using namespace units::literals;

constexpr int kCalls = 1000; // per measurement, for one is shorter than the clock's grain

BenchRow benchOne(const char* work, const ForceLaw& law)
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
  return benchRow(work, 0, sum > 0.0 ? "moving" : "", std::move(times));
}

} // namespace

std::vector<BenchRow> benchLaw()
{
  const ForceLaw paper = Scene{}.law;
  const Material& tissue = paper.material();
  const LawSettings everything{ .mode = LawMode::Corrected,
    .largeStrain = readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv")) };
  return { benchOne("law", paper),
    benchOne("law_cone", ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, tissue)),
    benchOne("law_exact", ForceLaw(paper.tip(), tissue, { .mode = LawMode::Exact })),
    benchOne("law_all", ForceLaw(paper.tip(), tissue, everything)) };
}

} // namespace palp
