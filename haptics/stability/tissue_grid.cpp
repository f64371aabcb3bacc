#include "haptics/stability/tissue_grid.h"

#include "haptics/contact/embed_nodules.h"
#include "haptics/stability/levels.h"
#include "haptics/units.h"

#include <array>
#include <map>
#include <memory>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kPoisson = 0.45;

// what a scene is made of
struct Tissue
{
  double modulus;  // [Pa]
  double relaxes;  // part of the modulus that decays [-]
  double friction; // mu [-]
  double nodule;   // its modulus over that of the tissue; 1: none
};

// 120 x 120 x 30 mm, its upper face at z = 0
std::shared_ptr<const Surface> block()
{
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(8);
  for (int i = 0; i < 8; ++i)
  {
    corners.emplace_back((i & 1) != 0 ? 60.0_mm : -60.0_mm, (i & 2) != 0 ? 60.0_mm : -60.0_mm,
      (i & 4) != 0 ? 0.0 : -30.0_mm);
  }
  return std::make_shared<const Surface>(std::move(corners),
    std::vector<Triangle>{ { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 },
      { 1, 5, 4 }, { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } });
}

std::shared_ptr<const Scene> sceneOf(
  const Tissue& tissue, const std::shared_ptr<const Surface>& surface)
{
  LawSettings settings{ .mode = LawMode::Corrected,
    .constitution = ConstitutiveModel::Linear,
    .friction = tissue.friction };
  if (tissue.relaxes > 0.0)
  {
    settings.relaxation.add({ 0.5 * tissue.relaxes, 30.0_ms });
    settings.relaxation.add({ 0.5 * tissue.relaxes, 0.5 });
  }
  auto scene = std::make_shared<Scene>();
  scene->surface = surface;
  scene->law = ForceLaw(
    SphereTip{ .radius = 10.0_mm }, makeMaterial(tissue.modulus, kPoisson), std::move(settings));
  scene->forceLimit = 4.0;
  if (tissue.nodule != 1.0) // where the tool ends, and one where it passes
  {
    scene->nodules = embedNodules(*scene->surface, scene->law,
      std::array{ PlacedNodule{ { 12.0_mm, 2.0_mm, -8.0_mm }, 5.0_mm, tissue.nodule },
        PlacedNodule{ { -4.0_mm, -3.0_mm, -7.0_mm }, 4.0_mm, tissue.nodule } });
  }
  return scene;
}

} // namespace

std::vector<StabilityCase> tissueCases(int count)
{
  std::mt19937 random(2);
  const auto levels = [&](std::initializer_list<double> values)
  { return Levels(values, count, random); };
  const Levels mass = levels({ 0.05, 0.1, 0.3, 1.0 });
  const Levels damping = levels({ 0.05, 0.2, 0.5, 2.0 });
  const Levels rubbing = levels({ 0.0, 0.1, 0.5 });
  const Levels quantum = levels({ 0.0, 10.0_um, 48.0_um, 100.0_um });
  const Levels delay = levels({ 0.0_ms, 1.0_ms, 3.0_ms, 5.0_ms });
  const Levels told = levels({ 0.0, 0.5, 1.0 });
  const Levels stiffness = levels({ 0.0, 300.0, 1000.0, 3000.0 });
  const Levels grip = levels({ 0.0, 0.6, 7.0 });
  const Levels rate = levels({ 300.0, 600.0, 1000.0 });
  const Levels drawn = levels({ 0.005, 0.02, 0.1 });
  const Levels modulus = levels({ 5.0_kPa, 50.0_kPa });
  const Levels relaxes = levels({ 0.0, 0.4, 0.9 });
  const Levels friction = levels({ 0.0, 0.3, 1.0 });
  const Levels nodule = levels({ 1.0, 0.2, 10.0 });
  const std::shared_ptr<const Surface> surface = block();
  std::map<std::array<double, 4>, std::shared_ptr<const Scene>> scenes;
  std::vector<StabilityCase> cases;
  for (int i = 0; i < count; ++i)
  {
    const Tissue tissue{ modulus[i], relaxes[i], friction[i], nodule[i] };
    std::shared_ptr<const Scene>& scene =
      scenes[{ tissue.modulus, tissue.relaxes, tissue.friction, tissue.nodule }];
    scene = scene != nullptr ? scene : sceneOf(tissue, surface);
    StabilityCase made{ .name = "arm at tissue that remembers",
      .material = makeMaterial(tissue.modulus, kPoisson),
      .tip = scene->law.tip(),
      .loop = {} };
    made.loop.period = 1.0 / rate[i];
    made.arm = ArmCase{ .mass = mass[i],
      .damping = damping[i],
      .friction = rubbing[i],
      .quantum = quantum[i],
      .delay = delay[i],
      .statedDelay = told[i] * delay[i],
      .handStiffness = stiffness[i],
      .handDamping = grip[i],
      .period = made.loop.period,
      .startSpeed = 0.05,
      .world = ArmWorld::Scene,
      .scene = scene,
      .drawnSpeed = drawn[i] };
    cases.push_back(std::move(made));
  }
  return cases;
}

} // namespace palp
