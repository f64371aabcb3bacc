#include "haptics/stability/arm_grid.h"

#include "haptics/stability/levels.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kRigid = std::numeric_limits<double>::infinity();

std::function<Response(double)> lawOf(const Tip& tip, double modulus)
{
  if (modulus == kRigid)
  {
    return [](double depth)
    { return depth > 0.0 ? Response{ .force = kRigid, .stiffness = kRigid } : Response{}; };
  }
  return [law = ForceLaw(tip, makeMaterial(modulus, 0.33))](double depth)
  { return law({ .depth = depth }); };
}

const char* nameOf(ArmWorld world)
{
  switch (world)
  {
    case ArmWorld::Sphere:
      return "arm at a curved surface";
    case ArmWorld::Workspace:
      return "arm at the end of its reach";
    case ArmWorld::Scene:
    case ArmWorld::Plane:
      break;
  }
  return "arm at a plane";
}

} // namespace

std::vector<StabilityCase> armCases(int count)
{
  std::mt19937 random(1);
  const auto levels = [&](std::initializer_list<double> values)
  { return Levels(values, count, random); };
  const Levels mass = levels({ 0.05, 0.1, 0.3, 1.0 });
  const Levels damping = levels({ 0.05, 0.1, 0.2, 0.5, 1.0, 2.0 });
  const Levels friction = levels({ 0.0, 0.05, 0.1, 0.2, 0.5 });
  const Levels quantum = levels({ 0.0, 10.0_um, 48.0_um, 100.0_um });
  const Levels delay = levels({ 0.0_ms, 0.5_ms, 1.0_ms, 2.0_ms, 3.0_ms, 4.0_ms, 5.0_ms });
  const Levels told = levels({ 0.0, 0.25, 0.5, 0.75, 1.0 });
  const Levels stiffness = levels({ 0.0, 0.0, 300.0, 1000.0, 3000.0 });
  const Levels grip = levels({ 0.0, 0.0, 0.6, 2.0, 7.0 });
  const Levels rate = levels({ 300.0, 400.0, 600.0, 1000.0 });
  const Levels world = levels({ 0.0, 0.0, 0.0, 1.0, 1.0, 2.0 });
  const Levels modulus = levels({ 5.0_kPa, 50.0_kPa, 1.5_MPa, kRigid });
  const Levels speed = levels({ 0.05, 0.2 });
  const Tip tip = SphereTip{ .radius = 10.0_mm };
  std::vector<StabilityCase> cases;
  for (int i = 0; i < count; ++i)
  {
    ArmCase arm{ .mass = mass[i],
      .damping = damping[i],
      .friction = friction[i],
      .quantum = quantum[i],
      .delay = delay[i],
      .statedDelay = told[i] * delay[i],
      .handStiffness = stiffness[i],
      .handDamping = grip[i],
      .period = 1.0 / rate[i],
      .startSpeed = speed[i],
      .world = static_cast<ArmWorld>(world[i]),
      .law = lawOf(tip, modulus[i]) };
    StabilityCase made{ .name = nameOf(arm.world), .material = {}, .tip = tip, .loop = {} };
    if (modulus[i] < kRigid)
    {
      made.material = makeMaterial(modulus[i], 0.33);
    }
    made.loop.period = arm.period;
    made.arm = std::move(arm);
    cases.push_back(std::move(made));
  }
  return cases;
}

StabilityRow judgeArm(const ArmCase& arm, bool chain)
{
  using Limits = ArmStabilityLimits;
  const ArmResult result = simulateArm(arm, chain);
  StabilityRow row{ .limitedBy = stagesIn(result.flags),
    .peakForce = result.peakForce,
    .limitCycleSpeed = result.lateSpeed,
    .energy = result.energy };
  const double between = 0.25 * arm.duration; // of middle and late speed
  const double decay =
    std::exp(-Limits::kDecay * (arm.damping + arm.handDamping) / (2.0 * arm.mass) * between);
  const bool swings = result.lateSpeed > StabilityLimits::kLimitCycleSpeed &&
    result.lateSpeed > decay * result.middleSpeed;
  const bool isBlind = arm.statedDelay < arm.delay;
  if (swings || result.energy < (isBlind ? Limits::kBlindEnergy : Limits::kEnergy))
  {
    row.outcome = StabilityOutcome::Unstable;
  }
  else if (result.peakForce == 0.0 || result.ended)
  {
    row.outcome = StabilityOutcome::Refused;
  }
  else if (row.limitedBy != "none")
  {
    row.outcome = StabilityOutcome::Limited;
  }
  return row;
}

} // namespace palp
