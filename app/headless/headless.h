#pragma once

#include "app/input/scene_plan.h"

namespace palp
{

class BuildTrace;
class OutputFolder;
struct ExportFolder;
struct Renderer;

/// Presses as a plan says in simulated time and publishes what the plan exports, with the scene by
/// which it can be repeated.
///
/// Ctrl-C ends the program and leaves the folder as it was.
///
/// @param plan      all that moves its tool is known
/// @param pictures  null only where the plan draws nothing
/// @param repeated  the folder that the plan is of; null: it is a new one
/// @throws Error    as loadBody, playInto, loadCalibration, writeDeformed, Renderer, OutputFolder;
///                  checkInputs
void playPlan(const ScenePlan& plan, OutputFolder& output, const Renderer* pictures,
  BuildTrace& trace, const ExportFolder* repeated = nullptr);

} // namespace palp
