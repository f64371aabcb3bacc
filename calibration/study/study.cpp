#include "calibration/study/study.h"

#include "calibration/study/mesh_check.h"
#include "calibration/study/study_files.h"
#include "haptics/error.h"
#include "haptics/files/fixed_text.h"
#include "haptics/units.h"

#include <cmath>
#include <optional>

namespace palp::fem
{
namespace
{

// change: on halving the elements [-]; infinite or NaN where it is not known
std::string refusal(const Case& study, double depth, double change)
{
  std::string why = "halving the elements may change it by " + fixed(100.0 * change, 1) + " %";
  if (!std::isfinite(change))
  {
    why = std::isnan(change) ? "it depends on the mesh"
                             : "no mesh twice as coarse finds one to tell its error";
  }
  return "indentation: the force at " + units::inMillimeters(depth) + " is refused, " + why +
    "; give --element-size " + units::inMillimeters(0.5 * elementSize(study)) + " or begin deeper";
}

// keep: called after every depth whose force stands
Outcome press(const Case& study, const Body& body, Saved saved, const std::stop_token& stop,
  MeshCheck* coarser, const std::function<void(const Outcome&, const Indenter&)>& keep,
  const Progress& progress)
{
  Outcome outcome{
    .steps = std::move(saved.steps), .error = {}, .refused = std::move(saved.refused)
  };
  Indenter indenter(body, study.tip, study.energy, study.material);
  double reached = 0.0;
  if (saved.checkpoint)
  {
    indenter.resume(*saved.checkpoint);
    reached = saved.checkpoint->depth * (1.0 + kSameDepth);
  }
  std::string refused = outcome.refused.empty() ? "" : refusal(study, outcome.refused.front(), NAN);
  try
  {
    for (std::size_t i = 0; i < study.depths.size(); ++i)
    {
      const double depth = study.depths[i];
      if (depth > reached)
      {
        indenter.press(depth, stop);
      }
      IndentationStep step = indenter.state();
      step.depth = depth; // the coarser run goes through those that were there, too
      const double change = coarser != nullptr ? coarser->changeOnHalving(step, stop) : 0.0;
      if (depth <= reached)
      {
        continue;
      }
      auto standing =
        change > kMeshError ? onFinerElements(study, depth, stop) : std::optional(std::move(step));
      if (stop.stop_requested())
      {
        throw Error(ErrorCode::NoSolution, kInterrupted);
      }
      if (standing)
      {
        outcome.steps.push_back(std::move(*standing));
        keep(outcome, indenter);
      }
      else
      {
        refused = refused.empty() ? refusal(study, depth, change) : refused;
        outcome.refused.push_back(depth);
      }
      if (progress)
      {
        progress(i + 1, study.depths.size());
      }
    }
    outcome.error = refused;
  }
  catch (const Error& error)
  {
    if (error.code() != ErrorCode::NoSolution)
    {
      throw;
    }
    outcome.error = error.what();
  }
  return outcome;
}

} // namespace

std::vector<std::string> calibrationFiles()
{
  return { "table.csv", "profiles.csv", "fit.json", "checkpoint.bin", "extent.png", "force.png",
    "profiles.png" };
}

Outcome calibrate(const Case& study, const std::stop_token& stop, const Progress& progress)
{
  check(study);
  const Body body = bodyOf(study);
  return press(
    study, body, {}, stop, nullptr, [](const Outcome&, const Indenter&) {}, progress);
}

Outcome calibrateInto(OutputFolder& folder, const Case& study, bool resume,
  const std::stop_token& stop, const Progress& progress)
{
  check(study);
  const Body body = bodyOf(study);
  const StudyFiles files(folder, study, body);
  // the volumetric block is as coarse as the paper's
  std::optional<MeshCheck> coarser;
  if (study.model == BodyModel::Axisymmetric)
  {
    coarser.emplace(study);
  }
  Outcome outcome = press(
    study, body, resume ? files.load() : Saved{}, stop, coarser ? &*coarser : nullptr,
    [&](const Outcome& reached, const Indenter& indenter)
    {
      files.write(reached);
      files.save(indenter.checkpoint(), reached.refused);
    },
    progress);
  if (!outcome.steps.empty()) // else what is there stays
  {
    files.write(outcome);
  }
  return outcome;
}

} // namespace palp::fem
