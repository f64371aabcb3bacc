#include "app/report/stability_study.h"

#include "app/input/tip_text.h"
#include "haptics/files/csv_text.h"
#include "haptics/files/fixed_text.h"
#include "haptics/units.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <thread>

namespace palp
{
namespace
{

// of the arms; what the other situations vary is in their names
std::vector<report::Cell> armCells(const std::optional<ArmCase>& arm)
{
  if (!arm)
  {
    return std::vector<report::Cell>(8, std::nan(""));
  }
  return { arm->mass, arm->damping, arm->friction, units::toMicrometers(arm->quantum),
    units::toMilliseconds(arm->delay), units::toMilliseconds(arm->statedDelay), arm->handStiffness,
    arm->handDamping };
}

std::vector<report::Cell> rowOf(const StabilityCase& what, const StabilityRow& row, bool chain)
{
  std::vector<report::Cell> cells{ what.name,
    what.material ? what.material->youngModulus : std::numeric_limits<double>::infinity(),
    what.material ? what.material->poissonRatio : std::nan(""), describeTip(what.tip),
    units::toMilliseconds(what.loop.period), chain ? "on" : "off", nameOf(row.outcome),
    row.limitedBy, row.peakForce, row.limitCycleSpeed, units::toMicrojoules(row.energy) };
  std::ranges::move(armCells(what.arm), std::back_inserter(cells));
  return cells;
}

std::ptrdiff_t count(
  const std::vector<JudgedCase>& cases, StabilityRow JudgedCase::*side, StabilityOutcome outcome)
{
  return std::ranges::count_if(
    cases, [&](const JudgedCase& one) { return (one.*side).outcome == outcome; });
}

} // namespace

// each case depends on nothing but itself, so their order of work does not matter
std::vector<JudgedCase> judgeAll(
  bool quick, std::stop_token stop, const std::function<void(double)>& tell)
{
  std::vector<JudgedCase> cases;
  for (StabilityCase& what : stabilityCases(quick))
  {
    cases.push_back({ .what = std::move(what), .chain = {}, .bare = {} });
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&]
  {
    for (std::size_t i = next++; i < cases.size() && !stop.stop_requested(); i = next++)
    {
      cases[i].chain = judge(cases[i].what, true);
      cases[i].bare = judge(cases[i].what, false);
      if (tell)
      {
        tell(static_cast<double>(i + 1) / static_cast<double>(cases.size()));
      }
    }
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
  {
    others.emplace_back(work);
  }
  work();
  others.clear();
  return cases;
}

report::Table stabilityTable(const std::vector<JudgedCase>& cases)
{
  report::Table table{ .name = "stability",
    .caption = "Every case, through the safety chain and without.",
    .columns = { "case", "young_Pa", "poisson", "tool", "period_ms", "chain", "outcome",
      "limited_by", "peak_force_N", "limit_cycle_speed_m_per_s", "energy_uJ", "mass_kg",
      "damping_N_s_per_m", "friction_N", "encoder_step_um", "delay_ms", "stated_delay_ms",
      "hand_stiffness_N_per_m", "hand_damping_N_s_per_m" },
    .shown = false };
  for (const JudgedCase& one : cases)
  {
    table.rows.push_back(rowOf(one.what, one.chain, true));
    table.rows.push_back(rowOf(one.what, one.bare, false));
  }
  return table;
}

// the sentence that the client asked for, with the rows behind each exception
std::string stabilitySummary(const std::vector<JudgedCase>& cases)
{
  using enum StabilityOutcome;
  std::ostringstream out;
  out << "Of " << cases.size() << " situations from 1 kPa to a rigid wall, "
      << count(cases, &JudgedCase::bare, Unstable)
      << " are unstable when the law goes to the motors as it is. Through the safety chain "
      << count(cases, &JudgedCase::chain, Unstable)
      << " are: " << count(cases, &JudgedCase::chain, Stable) << " are felt exactly, "
      << count(cases, &JudgedCase::chain, Limited) << " stably within a limit, "
      << count(cases, &JudgedCase::chain, Refused) << " are refused.\n";
  double worst = 0.0;
  double worstTold = 0.0; // where no delay is kept from the chain
  std::vector<std::string> named;
  for (const JudgedCase& one : cases)
  {
    worst = std::min(worst, one.chain.energy);
    const bool isTold = !one.what.arm || one.what.arm->statedDelay >= one.what.arm->delay;
    worstTold = isTold ? std::min(worstTold, one.chain.energy) : worstTold;
    if (one.chain.outcome >= Refused)
    {
      const std::string name = "  " + std::string(nameOf(one.chain.outcome)) + ": " + one.what.name;
      if (std::ranges::find(named, name) == named.end())
      {
        named.push_back(name);
      }
    }
  }
  for (const std::string& name : named)
  {
    out << name << '\n';
  }
  out << "Most energy that the chain gave to a hand: " << fixed(1e3 * std::abs(worst), 1)
      << " mJ; where its delay is told in full, " << fixed(1e3 * std::abs(worstTold), 1)
      << " mJ.\n";
  return out.str();
}

} // namespace palp
