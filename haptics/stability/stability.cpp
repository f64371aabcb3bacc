#include "haptics/stability/stability.h"

#include "haptics/stability/arm_grid.h"
#include "haptics/stability/tissue_grid.h"
#include "haptics/units.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace palp
{
namespace
{

using namespace units::literals;

constexpr double kInf = std::numeric_limits<double>::infinity();

// 1 kPa to 1 GPa; tissue, then rubber, then bone; infinite is a rigid wall
constexpr double kModuli[] = { 1.0_kPa, 5.0_kPa, 10.0_kPa, 50.0_kPa, 200.0_kPa, 1.5_MPa, 10.0_MPa,
  100.0_MPa, 1000.0_MPa, kInf };
constexpr double kRatios[] = { 0.0, 0.33, 0.45, 0.4999 };
constexpr int kArms = 5040;
constexpr int kQuickArms = 240;
constexpr int kTissues = 480;
constexpr int kQuickTissues = 24;
constexpr double kPeriods[] = { 0.25_ms, 0.5_ms, 1.0_ms, 2.0_ms, 4.0_ms };

std::vector<Tip> tips()
{
  return { SphereTip{ .radius = 10.0_mm }, ConeTip{ .halfAngle = 10.0_deg, .baseRadius = 10.0_mm },
    PunchTip{ .radius = 10.0_mm } };
}

std::function<Response(double)> lawOf(const Tip& tip, double modulus, double ratio)
{
  if (modulus == kInf)
  {
    return [](double depth)
    { return depth > 0.0 ? Response{ .force = kInf, .stiffness = kInf } : Response{}; };
  }
  return [law = ForceLaw(tip, makeMaterial(modulus, ratio))](double depth)
  { return law({ .depth = depth }); };
}

StabilityCase make(std::string name, const Tip& tip, double modulus, double ratio = 0.33)
{
  StabilityCase made{ .name = std::move(name), .material = {}, .tip = tip, .loop = {} };
  if (modulus < kInf)
  {
    made.material = makeMaterial(modulus, ratio);
  }
  made.loop.law = lawOf(tip, modulus, ratio);
  return made;
}

// appends a case of a tissue with something changed in its loop
struct Vary
{
  std::vector<StabilityCase>& cases;
  const Tip& tip;
  double modulus;

  template <typename Change>
  void operator()(const std::string& name, const Change& change) const
  {
    cases.push_back(make(name, tip, modulus));
    change(cases.back().loop);
  }
};

void addTimings(const Vary& vary)
{
  for (const double jitter : { 0.2, 0.5 })
  {
    vary(
      jitter < 0.3 ? "jitter 20 %" : "jitter 50 %", [&](LoopCase& loop) { loop.jitter = jitter; });
  }
  for (const int dropped : { 1, 3, 5, 20 })
  {
    vary(std::to_string(dropped) + (dropped == 1 ? " tick" : " ticks") + " lost 4 times a second",
      [&](LoopCase& loop) { loop.dropped = dropped; });
  }
  for (const int dropped : { 20, 100 })
  {
    vary(std::to_string(dropped) + " ticks lost every 4 s",
      [&](LoopCase& loop)
      {
        loop.dropped = dropped;
        loop.dropEvery = 4.0;
      });
  }
  for (const int delay : { 1, 2 })
  {
    vary("delay of " + std::to_string(delay) + (delay == 1 ? " tick" : " ticks"),
      [&](LoopCase& loop) { loop.plant.delay = delay; });
  }
}

void addDevices(const Vary& vary)
{
  for (const int damping : { 2, 5, 20, 50 })
  {
    vary("virtual damping of " + std::to_string(damping) + " N s/m",
      [&](LoopCase& loop) { loop.damping = damping; });
  }
  vary("light device",
    [](LoopCase& loop)
    {
      loop.plant.mass = 0.05;
      loop.plant.damping = 0.2;
    });
  vary("light late device damped 20 N s/m",
    [](LoopCase& loop)
    {
      loop.plant.mass = 0.05;
      loop.plant.damping = 0.2;
      loop.plant.delay = 1;
      loop.damping = 20.0;
    });
  vary("heavy device",
    [](LoopCase& loop)
    {
      loop.plant.mass = 0.3;
      loop.plant.damping = 2.0;
    });
  vary("damping half of stated",
    [](LoopCase& loop) { loop.plant.statedDamping = 2.0 * loop.plant.damping; });
  vary("damping not stated", [](LoopCase& loop) { loop.plant.statedDamping = 0.0; });
}

void addHands(const Vary& vary)
{
  vary("first touch", [](LoopCase& loop) { loop.plant.startSpeed = loop.plant.handForce = 0.01; });
  vary("tap at 1 m/s", [](LoopCase& loop) { loop.plant.startSpeed = 1.0; });
  vary("lean with 3.5 N", [](LoopCase& loop) { loop.plant.handForce = 3.5; });
}

// of the tissue under the tool
void addChanges(const Vary& vary)
{
  vary("tissue softens", [&](LoopCase& loop) { loop.swapped = lawOf(vary.tip, 5.0_kPa, 0.33); });
  vary("tissue stiffens", [&](LoopCase& loop) { loop.swapped = lawOf(vary.tip, 10.0_MPa, 0.33); });
  for (const double rise : { -2.0_mm, 2.0_mm })
  {
    vary(rise < 0.0 ? "surface sinks 2 mm" : "surface rises 2 mm",
      [&](LoopCase& loop)
      {
        loop.swapped = loop.law;
        loop.swapRise = rise;
      });
  }
}

// tissue against everything that a loop, a device or a hand may do
void addVariations(const Vary& vary)
{
  addTimings(vary);
  addDevices(vary);
  addHands(vary);
  addChanges(vary);
}

} // namespace

std::vector<StabilityCase> stabilityCases(bool quick)
{
  std::vector<StabilityCase> cases;
  for (const Tip& tip : tips())
  {
    for (const double modulus : kModuli)
    {
      for (const double period : kPeriods)
      {
        for (const double ratio : kRatios)
        {
          if ((modulus == kInf && ratio != 0.33) || (quick && (period != 1.0_ms || ratio != 0.33)))
          {
            continue;
          }
          cases.push_back(make("material", tip, modulus, ratio));
          cases.back().loop.period = period;
        }
      }
    }
    for (const double modulus : { 5.0_kPa, 50.0_kPa, 1.5_MPa, kInf })
    {
      if (!quick || (tip.index() == 0 && modulus != 5.0_kPa && modulus != 1.5_MPa))
      {
        addVariations({ cases, tip, modulus });
      }
    }
  }
  std::ranges::move(armCases(quick ? kQuickArms : kArms), std::back_inserter(cases));
  std::ranges::move(tissueCases(quick ? kQuickTissues : kTissues), std::back_inserter(cases));
  return cases;
}

StabilityRow judge(const StabilityCase& which, bool chain)
{
  if (which.arm)
  {
    return judgeArm(*which.arm, chain);
  }
  LoopCase loop = which.loop;
  if (chain)
  {
    loop.chain = SafetySettings{};
  }
  const LoopResult exact = simulate(loop);
  loop.plant.quantum = StabilityLimits::kLimitCycleQuantum;
  const LoopResult coarse = simulate(loop);

  StabilityRow row{ .limitedBy = stagesIn(exact.flags | coarse.flags),
    .peakForce = std::max(exact.peakForce, coarse.peakForce),
    .limitCycleSpeed = coarse.limitCycleSpeed,
    .energy = exact.energy };
  const double early = std::max(exact.earlySpeed, StabilityLimits::kAtRest);
  if (row.energy < StabilityLimits::kEnergy ||
    exact.limitCycleSpeed > StabilityLimits::kEnvelope * early ||
    row.limitCycleSpeed > StabilityLimits::kLimitCycleSpeed)
  {
    row.outcome = StabilityOutcome::Unstable;
  }
  else if (row.peakForce == 0.0 || (exact.ended && coarse.ended))
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
