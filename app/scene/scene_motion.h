#pragma once

#include "app/input/json_object.h"
#include "app/input/scene_plan.h"

#include <filesystem>

namespace palp
{

/// Reads what moves the tool, where it may be felt, and whether there is a window: the keys device,
/// presses, recording, dead_man, window and chain.
///
/// @param folder  of the files that they name
/// @throws Error  BadFile: names the key
void readMotion(JsonObject& scene, ScenePlan& plan, const std::filesystem::path& folder);

/// Reads what is hidden and what was marked.
/// @throws Error  BadFile: names the key
[[nodiscard]] TrainingPlan readTraining(JsonObject object);

/// @throws Error  BadFile: names the key
[[nodiscard]] CameraPlace readCamera(JsonObject object);

} // namespace palp
