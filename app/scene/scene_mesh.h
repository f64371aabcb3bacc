#pragma once

#include "app/input/json_object.h"
#include "app/input/scene_plan.h"

#include <filesystem>

namespace palp
{

/// Reads a surface, where it is, and the nodules or the map in it.
///
/// @param folder  of the files that it names
/// @throws Error  BadFile: names the key
[[nodiscard]] MeshSource readMesh(JsonObject object, const std::filesystem::path& folder);

} // namespace palp
