#include "app/bench/bench.h"
#include "app/program/data_files.h"
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

// ten of them in a row, 20 mm apart
std::shared_ptr<const NoduleField> nodulesUnder(const ForceLaw& law)
{
  std::vector<EmbeddedNodule> nodules;
  for (int i = 0; i < 10; ++i)
  {
    nodules.push_back({ .nodule = { { 20.0_mm * i, 0.0, -10.0_mm }, 5.0_mm, 5.0 },
      .depth = 10.0_mm,
      .place = { .thickness = 30.0_mm } });
  }
  return std::make_shared<const NoduleField>(law, std::move(nodules));
}

// what a tick of tissue that relaxes and rubs takes above one that does not
BenchRow benchMemory(const char* variant, const Material& tissue, LawSettings settings)
{
  settings.relaxation.add({ 0.3, 50.0_ms });
  settings.relaxation.add({ 0.2, 0.6 });
  settings.friction = 0.3;
  Scene scene;
  scene.law = ForceLaw(scene.law.tip(), tissue, settings);
  scene.nodules = *variant != '\0' ? nodulesUnder(scene.law) : nullptr;
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
  const LawSettings everything{ .mode = LawMode::Corrected,
    .largeStrain = readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv")) };
  LawSettings coated = everything;
  coated.coatings.add({ 2.0_mm, { 4.0 * tissue.youngModulus, tissue.poissonRatio } });
  return { benchOne("", paper), benchOne("cone", ForceLaw(ConeTip{ 45.0_deg, 10.0_mm }, tissue)),
    benchOne("exact", ForceLaw(paper.tip(), tissue, { .mode = LawMode::Exact })),
    benchOne("corrected", ForceLaw(paper.tip(), tissue, everything)),
    benchOne("paraboloid", ForceLaw(ParaboloidTip{ 10.0_mm }, tissue, everything)),
    benchOne("coated", ForceLaw(paper.tip(), tissue, coated)), benchMemory("", tissue, everything),
    benchMemory("nodules", tissue, everything) };
}

} // namespace palp
