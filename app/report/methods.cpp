#include "app/report/methods.h"

#include "app/bench/bench.h"
#include "app/bench/bench_work.h"
#include "app/program/data_files.h"
#include "calibration/study/study.h"
#include "calibration/tables/extent_table.h"
#include "haptics/error.h"
#include "haptics/force/force_law.h"
#include "haptics/numerics/monotone_cubic.h"
#include "haptics/numerics/statistics.h"
#include "haptics/units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp::report
{
namespace
{

using namespace units::literals;

constexpr int kCalls = 1000; // per measurement, for one is shorter than the clock's grain

// times and values of a function of the depth that takes nanoseconds
template <typename Force>
void measure(Trial& trial, std::span<const double> depths, const Effort& effort, Force forceAt)
{
  for (const double depth : depths)
  {
    effort.check();
    trial.forces.push_back(forceAt(depth));
    double sum = 0.0;
    const auto measured = timed(
      21, [](int) {},
      [&](int k)
      {
        for (int call = 0; call < kCalls; ++call)
        {
          sum += forceAt(depth + 1e-12 * (call + k));
        }
      });
    trial.times.push_back({ sum > 0.0 ? statisticsOf(measured).median / kCalls : 0.0 });
  }
}

// F(depth) through the rows of a calibration, smooth and monotone
class ForceTable
{
public:
  explicit ForceTable(const ExtentTable& table)
    : depths_{ 0.0 }
    , forces_{ 0.0 }
  {
    for (const ExtentTable::Extent& row : table.rows())
    {
      depths_.push_back(row.depth);
      forces_.push_back(row.force);
    }
    slopes_ = monotoneSlopes(depths_, forces_);
  }

  double operator()(double depth) const
  {
    const auto above = std::ranges::upper_bound(depths_, depth);
    if (above == depths_.end())
    {
      return depth == depths_.back() ? forces_.back() : std::numeric_limits<double>::quiet_NaN();
    }
    const auto i = static_cast<std::size_t>(above - depths_.begin());
    const double width = depths_[i] - depths_[i - 1];
    return hermite((depth - depths_[i - 1]) / width, width, forces_[i - 1], forces_[i],
      slopes_[i - 1], slopes_[i])
      .value;
  }

private:
  std::vector<double> depths_;
  std::vector<double> forces_;
  std::vector<double> slopes_;
};

Trial start(const char* method, const char* leavesOut, fem::StrainEnergy like)
{
  return { method, "", leavesOut, like, {}, {} };
}

const char* omissionsOf(fem::StrainEnergy energy)
{
  switch (energy)
  {
    case fem::StrainEnergy::Linear:
      return "large strain, rotation, the sideways motion of what is touched; inertia, friction";
    case fem::StrainEnergy::Corotated:
      return "stiffening at large strain; inertia, friction";
    default:
      return "inertia, friction; the square block is a cylinder of equal area";
  }
}

const char* omissionsOf(fem::Baseline baseline)
{
  switch (baseline)
  {
    case fem::Baseline::Corotational:
      return "stiffening at large strain; what is smaller than its elements; friction";
    case fem::Baseline::MassSpring:
      return "Poisson's ratio, which is 1/4; volume; the stress of a continuum; friction";
    default:
      return "the stress of a continuum; what is smaller than its springs; friction";
  }
}

} // namespace

std::vector<Trial> tryLaws(
  const BlockPress& press, std::span<const double> depths, const Effort& effort)
{
  const LawSettings corrected{ .mode = LawMode::Corrected,
    .largeStrain = readLargeStrain(
      dataFile("tables/large_strain_sphere.csv"), dataFile("tables/large_strain_cone.csv")) };
  const ForceLaw paper(press.sharp, kTissue);
  const ForceLaw exact(press.tip, kTissue, { .mode = LawMode::Exact });
  const ForceLaw full(press.tip, kTissue, corrected);
  const ForceTable table(ExtentTable::read(dataFile("tables/" + press.table + ".csv")));

  std::vector<Trial> trials;
  const auto add =
    [&](const char* method, const char* leavesOut, fem::StrainEnergy like, auto forceAt)
  { measure(trials.emplace_back(start(method, leavesOut, like)), depths, effort, forceAt); };
  add("paper law", "thickness and width of the body, large strain; that r is not small",
    fem::StrainEnergy::Linear, [&](double depth) { return paper({ .depth = depth }).force; });
  add("exact half-space", "thickness and width of the body, large strain",
    fem::StrainEnergy::Linear, [&](double depth) { return exact({ .depth = depth }).force; });
  add("corrected law", "width of the body, friction, inertia", fem::StrainEnergy::NeoHookean,
    [&](double depth) { return full({ .depth = depth, .thickness = press.height }).force; });
  add("table", "every tool, body and nu but its own, tilt, curvature; friction, inertia",
    fem::StrainEnergy::NeoHookean, [&](double depth) { return table(depth); });
  return trials;
}

Trial tryElements(const BlockPress& press, fem::StrainEnergy energy, double size,
  std::span<const double> depths, const Effort& effort, std::vector<fem::IndentationStep>* surfaces)
{
  Trial trial = start("", omissionsOf(energy), energy);
  trial.method = "finite elements " + std::string(fem::name(energy));
  trial.setting = "h R/" + std::to_string(std::lround(1.0 / size));
  trial.forces.assign(depths.size(), std::numeric_limits<double>::quiet_NaN());
  trial.times.resize(depths.size());
  const fem::Case study{ .name = press.name,
    .height = press.height,
    .tip = press.tip,
    .material = kTissue,
    .energy = energy,
    .depths = { depths.begin(), depths.end() },
    .elementSize = size * press.size };
  const fem::Body body = fem::bodyOf(study);
  fem::Indenter indenter(body, press.tip, energy, kTissue);
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    effort.check();
    try
    {
      trial.times[i] = timed(
        1, [](int) {}, [&](int) { indenter.press(depths[i]); });
    }
    catch (const Error&)
    {
      break; // no equilibrium so deep: the rows of this regime are left out
    }
    const fem::IndentationStep state = indenter.state();
    trial.forces[i] = state.force;
    if (surfaces)
    {
      surfaces->push_back(state);
    }
  }
  return trial;
}

fem::TetMesh baselineBody(double height)
{
  constexpr int kSide = 40; // 1,600 vertices
  constexpr int kLayers = 10;
  return fem::blockTets(100.0_mm, height, kSide, kLayers);
}

Trial trySteps(const BlockPress& press, fem::Baseline baseline, std::span<const double> depths,
  const std::function<bool(double)>& wanted, const Effort& effort)
{
  constexpr double kStill = 1e-3; // change of the force in a step [-]
  constexpr int kMaxSteps = 100;
  constexpr int kTimed = 5;
  const bool elements = baseline == fem::Baseline::Corotational;
  Trial trial = start("", omissionsOf(baseline),
    elements ? fem::StrainEnergy::Corotated : fem::StrainEnergy::NeoHookean);
  trial.method = fem::name(baseline);
  trial.setting = "1600 vertices";
  trial.forces.assign(depths.size(), std::numeric_limits<double>::quiet_NaN());
  trial.times.resize(depths.size());
  fem::Stepper stepper(baselineBody(press.height), baseline, press.tip, kTissue);
  for (std::size_t i = 0; i < depths.size(); ++i)
  {
    if (!wanted(depths[i]))
    {
      continue;
    }
    effort.check();
    const Eigen::Vector3d apex(0.0, 0.0, -depths[i]);
    stepper.placeTool(apex);
    try
    {
      trial.forces[i] = fem::settle(stepper, kGraphicsStep, kStill, kMaxSteps).force;
    }
    catch (const Error&)
    {
      continue; // it never rests there
    }
    const std::vector<Eigen::Vector3d> further(kTimed, apex - 0.01_mm * Eigen::Vector3d::UnitZ());
    for (const double time : fem::timeSteps(stepper, further, kGraphicsStep).milliseconds)
    {
      trial.times[i].push_back(time * 1e3); // [us]
    }
  }
  return trial;
}

SurfaceTrial tryDent(const BlockPress& press, std::span<const ReferenceSurface> references,
  bool fitted, const Effort& effort)
{
  SurfaceTrial trial{ .method = fitted ? "fitted Bezier" : "paper Bezier",
    .setting = std::to_string(kDrawnPoints) + " vertices",
    .leavesOut = fitted ? "every tool, body and nu but its own; volume"
                        : "the surface beyond R_d, where it is still 0.5 mm deep; volume",
    .surfaces = {},
    .times = {} };
  VisualUpdate step(kDrawnSide, press.tip, press.table, fitted);
  for (const ReferenceSurface& reference : references)
  {
    effort.check();
    auto& times = trial.times.emplace_back();
    for (int i = 0; i < effort.repeats(); ++i)
    {
      const auto measured = timed(
        41, [](int) {},
        [&](int k) {
          step(straightDown({ 2.0_mm * (k % 20 - 10), 0.0, -reference.depth }));
        });
      times.push_back(statisticsOf(measured).median);
    }
    step(straightDown({ 0.0, 0.0, -reference.depth }));
    Drawn drawn;
    for (std::size_t i = 0; i < step.vertices(); ++i)
    {
      const Eigen::Vector3d vertex = step.vertex(i);
      if (std::abs(vertex.y()) < 1e-6 && vertex.x() > -1e-6) // the row from the axis outwards
      {
        drawn.emplace_back(vertex.x(), -vertex.z());
      }
    }
    trial.surfaces.push_back(std::move(drawn));
  }
  return trial;
}

SurfaceTrial tryElementSurface(const BlockPress& press,
  std::span<const ReferenceSurface> references, double size, const Effort& effort)
{
  std::vector<double> depths;
  for (int i = 1; i * 0.5_mm < references.back().depth + 0.1_mm; ++i)
  {
    depths.push_back(i * 0.5_mm);
  }
  std::vector<fem::IndentationStep> steps;
  const Trial forces =
    tryElements(press, fem::StrainEnergy::NeoHookean, size, depths, effort, &steps);
  SurfaceTrial trial{ .method = "finite elements",
    .setting = forces.setting,
    .leavesOut = forces.leavesOut,
    .surfaces = {},
    .times = {} };
  for (const ReferenceSurface& reference : references)
  {
    const auto found = std::ranges::min_element(steps, {},
      [&](const fem::IndentationStep& step) { return std::abs(step.depth - reference.depth); });
    Drawn drawn;
    for (const auto& point : found->profile)
    {
      drawn.emplace_back(point.radius + point.ur, -point.uz);
    }
    trial.surfaces.push_back(std::move(drawn));
    trial.times.push_back(forces.times[static_cast<std::size_t>(found - steps.begin())]);
  }
  return trial;
}

} // namespace palp::report
