#pragma once

#include "app/input/scene_plan.h"

#include <filesystem>
#include <string>

namespace palp
{

/// The scene file of a plan: parseScene() of it gives the plan back to the last bit, and this text
/// again.
///
/// @param folder  that the scene will stand in: files there are named as such, all others with
///                their whole path
[[nodiscard]] std::string sceneText(const ScenePlan& plan, const std::filesystem::path& folder);

} // namespace palp
