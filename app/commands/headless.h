#pragma once

#include "app/input/scene_plan.h"

namespace palp
{

class BuildTrace;
class OutputFolder;
struct Renderer;

/// The names of all files that playPlan may leave.
[[nodiscard]] std::vector<std::string> pressFiles();

/// Presses along the plan's path in simulated time and publishes what the plan exports.
///
/// Ctrl-C ends the program and leaves the folder as it was.
///
/// @param plan      its device is scripted
/// @param chained   the force goes through the safety chain of the paper's device, armed
/// @param pictures  null only where the plan draws nothing
/// @throws Error    as loadBody, readPath, loadCalibration, writeDeformed, Renderer, OutputFolder
void playPlan(const ScenePlan& plan, bool chained, OutputFolder& output, const Renderer* pictures,
  BuildTrace& trace);

} // namespace palp
