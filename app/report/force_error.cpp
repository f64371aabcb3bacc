#include "app/bench/bench.h"
#include "app/report/methods.h"
#include "app/report/pareto.h"
#include "app/report/parts.h"
#include "haptics/numerics/statistics.h"
#include "haptics/units.h"

#include <cmath>
#include <map>
#include <set>

namespace palp::report
{
namespace
{

using fem::StrainEnergy;

constexpr std::array kEnergies{ StrainEnergy::Linear, StrainEnergy::Corotated,
  StrainEnergy::NeoHookean };

std::string join(const std::string& a, const std::string& b)
{
  return b.empty() ? a : a + "; " + b;
}

std::string settingOf(const BlockPress& press, StrainEnergy against, const std::string& own)
{
  return join(press.name + "; against " + std::string(fem::name(against)), own);
}

// times of all evaluations in a regime; none where its deepest press was not reached
std::vector<double> timesIn(
  const Trial& trial, const ReferenceForces& reference, const Regime& regime, double size)
{
  std::vector<double> times;
  bool reached = false;
  for (std::size_t i = 0; i < reference.depths.size(); ++i)
  {
    if (isIn(regime, reference.depths[i], size))
    {
      reached = !std::isnan(trial.forces[i]);
      times.insert(times.end(), trial.times[i].begin(), trial.times[i].end());
    }
  }
  return reached ? times : std::vector<double>();
}

// the first or the last depth of a regime, for methods that take long
bool isBorder(const ReferenceForces& reference, double depth, double size)
{
  return std::ranges::any_of(kRegimes,
    [&](const Regime& regime)
    {
      bool before = false;
      bool after = false;
      for (const double other : reference.depths)
      {
        before = before || (other < depth && isIn(regime, other, size));
        after = after || (other > depth && isIn(regime, other, size));
      }
      return isIn(regime, depth, size) && !(before && after);
    });
}

struct Tables
{
  double sweep = benchSweep(); // S [us]
  Table errors{ .name = "error_vs_time",
    .caption = "Error of every method, setting and regime.",
    .columns = { "method", "setting", "regime", "time_us", "error_max_pct", "error_rms_pct",
      "error_local_pct" },
    .shown = false };
  Table spread{ .name = "time_spread",
    .caption =
      "Statistics of the times: median, lowest and highest of the evaluations of a regime.",
    .columns = { "method", "setting", "regime", "evaluations", "time_us", "low_us", "high_us",
      "time_per_S" },
    .shown = false };
  Table summary{ .name = "error_summary",
    .caption = "RMS error of the force in each regime against neo-Hookean elements of others "
               "[% of the regime's largest force], and what each method leaves out.",
    .columns = { "press", "method", "setting", "time_us", "shallow_rms_pct", "jnd_rms_pct",
      "deep_rms_pct", "leaves_out" } };
};

void addTrial(Tables& tables, const BlockPress& press, const Trial& trial)
{
  for (const StrainEnergy against : { StrainEnergy::NeoHookean, trial.like })
  {
    const ReferenceForces reference = referenceForces(press, against);
    const std::string setting = settingOf(press, against, trial.setting);
    std::vector<Cell> line{ press.name, trial.method, trial.setting };
    std::vector<double> all;
    for (const Regime& regime : kRegimes)
    {
      const auto times = timesIn(trial, reference, regime, press.size);
      const bool known = !times.empty();
      all.insert(all.end(), times.begin(), times.end());
      const ForceError error =
        known ? forceError(reference, trial.forces, regime, press.size) : ForceError{};
      line.emplace_back(known ? error.rms : std::nan(""));
      if (known)
      {
        const Statistics spread = statisticsOf(times);
        tables.errors.rows.push_back({ trial.method, setting, regime.name, spread.median,
          error.largest, error.rms, error.local });
        tables.spread.rows.push_back(
          { trial.method, setting, regime.name, static_cast<double>(times.size()), spread.median,
            spread.low, spread.high, spread.median / tables.sweep });
      }
    }
    if (against == StrainEnergy::NeoHookean)
    {
      line.insert(line.begin() + 3, all.empty() ? std::nan("") : statisticsOf(all).median);
      line.emplace_back(trial.leavesOut);
      tables.summary.rows.push_back(std::move(line));
    }
    if (trial.like == StrainEnergy::NeoHookean)
    {
      break; // one reference only
    }
  }
}

// the same mark for a method in every figure
struct ForceMark
{
  const char* method;
  Curve::Style style;
  int color;
};
constexpr std::array kForceMarks{ ForceMark{ "paper law", Curve::Style::Circles, 2 },
  ForceMark{ "exact half-space", Curve::Style::Circles, 6 },
  ForceMark{ "corrected law", Curve::Style::Circles, 1 },
  ForceMark{ "table", Curve::Style::Squares, 3 },
  ForceMark{ "finite elements linear", Curve::Style::Diamonds, 4 },
  ForceMark{ "finite elements corotated", Curve::Style::Diamonds, 5 },
  ForceMark{ "finite elements neo-hookean", Curve::Style::Diamonds, 0 },
  ForceMark{ "mass-spring", Curve::Style::Squares, 5 },
  ForceMark{ "mass-spring-volume", Curve::Style::Squares, 6 },
  ForceMark{ "corotational", Curve::Style::Squares, 2 } };

void addForceFigures(Section& section, const BlockPress& press)
{
  const std::string setting = settingOf(press, StrainEnergy::NeoHookean, "");
  for (const Regime& regime : kRegimes)
  {
    Figure figure{
      .name = "error_vs_time_" + fileWord(press.name) + "_" + fileWord(regime.name),
      .caption = regime.name,
      .bottom = "time of one evaluation [\u00b5s]",
      .left = "RMS error of the force [%]",
      .logBottom = true,
      .logLeft = true,
      .group = "RMS error of the force against the time of one evaluation, " + press.name +
        ". Lower and further left is better; what no other method beats in both lies on the front."
    };
    for (const ForceMark& mark : kForceMarks)
    {
      figure.curves.push_back({ .label = mark.method,
        .table = "error_vs_time",
        .x = "time_us",
        .y = "error_rms_pct",
        .where = { { "method", mark.method }, { "setting", setting }, { "regime", regime.name } },
        .style = mark.style,
        .color = mark.color });
    }
    for (const auto& [front, color] : { std::pair{ "all methods", 7 }, std::pair{ "no table", 0 } })
    {
      figure.curves.push_back({ .label = "Pareto front, " + std::string(front),
        .table = "pareto_front",
        .x = "time_us",
        .y = "error_rms_pct",
        .where = { { "front", front }, { "setting", setting }, { "regime", regime.name } },
        .style = Curve::Style::Dashed,
        .color = color });
    }
    section.figures.push_back(std::move(figure));
  }
}

// what a reader asks first: which of the laws lie on the fronts
std::string finding(const Table& front)
{
  std::set<std::string> cases; // press and regime
  std::map<std::string, std::array<std::set<std::string>, 2>> laws;
  for (const auto& row : front.rows)
  {
    const auto& setting = std::get<std::string>(row[front.indexOf("setting")]);
    const std::string which = setting.substr(0, setting.find(';')) + ", " +
      std::get<std::string>(row[front.indexOf("regime")]);
    const bool withTable = row[front.indexOf("front")] == Cell("all methods");
    cases.insert(which);
    laws[std::get<std::string>(row[front.indexOf("method")])][withTable ? 0 : 1].insert(which);
  }
  const auto all = std::to_string(cases.size());
  std::string text = "Of " + all + " fronts (presses times regimes)";
  const char* separator = " ";
  for (const char* law : { "paper law", "exact half-space", "corrected law", "table" })
  {
    text.append(separator).append("the ").append(law).append(" is on ");
    text.append(std::to_string(laws[law][0].size()));
    text.append(law == std::string("table")
        ? ""
        : ", or " + std::to_string(laws[law][1].size()) + " without the table");
    separator = "; ";
  }
  return text + ". The table is our own calibration of this very press and knows no other.";
}

constexpr double kTrials =
  kEnergies.size() * kResolutions.size() + fem::kBaselines.size() + 1; // of a press

// every method once, in the same order each time
std::vector<Trial> tryAll(const BlockPress& press, const ReferenceForces& reference,
  const Effort& effort, bool again, const std::function<void()>& tried)
{
  std::vector<double> depths = reference.depths;
  std::erase_if(depths, [&](double depth) { return depth > press.size * (1.0 + 1e-9); });
  std::vector<Trial> trials = tryLaws(press, depths, effort);
  tried();
  const auto wanted = [&](double depth)
  {
    const double depthMm = units::toMillimeters(depth);
    return isBorder(reference, depth, press.size) ||
      (!effort.quick && std::abs(depthMm - std::round(depthMm)) < 1e-6);
  };
  for (const fem::Baseline baseline : fem::kBaselines)
  {
    // they take long to come to rest, and then many steps are timed
    trials.push_back(again ? Trial{} : trySteps(press, baseline, depths, wanted, effort));
    tried();
  }
  for (const StrainEnergy energy : kEnergies)
  {
    for (const double size : kResolutions)
    {
      const bool skipped = again && effort.quick && size < 0.2;
      trials.push_back(skipped ? Trial{} : tryElements(press, energy, size, depths, effort));
      tried();
    }
  }
  return trials;
}

// repeated in turns, so that what else the machine does meets all methods
void measurePress(
  Tables& tables, const BlockPress& press, const Effort& effort, const std::function<void()>& tried)
{
  const ReferenceForces reference = referenceForces(press, StrainEnergy::NeoHookean);
  std::vector<Trial> trials = tryAll(press, reference, effort, false, tried);
  for (int repeat = 1; repeat < effort.repeats(); ++repeat)
  {
    const auto more = tryAll(press, reference, effort, true, tried);
    for (std::size_t i = 0; i < trials.size(); ++i)
    {
      for (std::size_t depth = 0; depth < more[i].times.size(); ++depth)
      {
        auto& times = trials[i].times[depth];
        times.insert(times.end(), more[i].times[depth].begin(), more[i].times[depth].end());
      }
    }
  }
  for (const Trial& trial : trials)
  {
    addTrial(tables, press, trial);
  }
}

} // namespace

Section forceAgainstTime(const Effort& effort)
{
  Tables tables;
  const std::span all(presses());
  const auto wanted = effort.quick ? all.first(1) : all;
  const double work = kTrials * effort.repeats() * static_cast<double>(wanted.size());
  double done = 0.0;
  for (const BlockPress& press : wanted)
  {
    measurePress(tables, press, effort, [&] { effort.reached(++done / work); });
  }
  Section section;
  section.text = {
    "Each point is one method. Reference: axisymmetric finite elements of an independent program, "
    "neo-Hookean, 50 kPa, nu 0.33, bonded base (data/reference); methods made for small strain or "
    "for a corotated material are compared with that program's small-strain and corotated forces "
    "too (settings 'against linear' and 'against corotated' of the CSV), which is where their "
    "discretisation shows without their material.",
    "Regimes, by depth over the tool's radius R: shallow to 0.25, JND limit 0.25 to 0.55 (where "
    "the paper finds 7 %), depth = R 0.55 to 1. Maximum and RMS are over the depths of a regime in "
    "per cent of its largest reference force, as in Eq. (9); local is the largest error relative "
    "to the reference force at the same depth, which is what a hand judges by.",
    "Time is that of one more force: for a law one evaluation; for finite elements the step from "
    "the depth half a millimeter before; for the steppers one step of their time integration, at "
    "the ends of each regime and, in a full report, whole millimeters. "
    "Medians of " +
      std::to_string(effort.repeats()) +
      " runs, one for elements below R/4 in a quick report; their spread is in time_spread.csv."
  };
  Table front{ .name = "pareto_front",
    .caption = "The Pareto fronts: no other method is both faster and more accurate; with the "
               "table of this very press among them, and without it.",
    .columns = { "front", "method", "setting", "regime", "time_us", "error_rms_pct" },
    .shown = false };
  for (const BlockPress& press : wanted)
  {
    const std::string setting = settingOf(press, StrainEnergy::NeoHookean, "");
    addParetoFront(front, "all methods", tables.errors, setting, "");
    addParetoFront(front, "no table", tables.errors, setting, "table");
  }
  section.text.insert(section.text.begin(), finding(front));
  section.tables = { std::move(tables.summary), std::move(front), std::move(tables.errors),
    std::move(tables.spread) };
  for (const BlockPress& press : wanted)
  {
    addForceFigures(section, press);
  }
  return section;
}

} // namespace palp::report
