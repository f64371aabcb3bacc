#pragma once

#include "app/input/scene_plan.h"
#include "app/press/body.h"
#include "app/press/recording.h"
#include "haptics/devices/simulated/scripted_path.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp
{

/// Presses as a plan says, in simulated time: at its places, along its path, or once more as it was
/// recorded; and leaves the samples that the plan exports.
///
/// @param recording  its scene is pressed; its device, names and samples are filled
/// @param path       of the plan's device; null where it has places or a recording
/// @return           notes on presses that met another organ than that of their place
/// @throws Error     as pathsOf, checkStart, play, readRows
std::vector<std::string> playInto(
  Recording& recording, const ScenePlan& plan, const ScriptedPath* path);

/// The files that a plan names.
[[nodiscard]] std::vector<std::filesystem::path> inputsOf(const ScenePlan& plan);

/// The plan by which a live recording is repeated and drawn: its body, tool, tissue and law.
///
/// @param opened  of the window: what a recording does not tell
[[nodiscard]] ScenePlan planOf(
  const ScenePlan& opened, const SceneBody& body, const Recording& recording);

} // namespace palp
