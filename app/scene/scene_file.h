#pragma once

#include "app/input/scene_plan.h"

namespace palp
{

/// Reads a scene: one JSON object, version 1, described by data/scenes/scene.schema.json.
///
/// Files that it names stand beside it. Every quantity carries its unit.
///
/// @param text    whole file
/// @param file    its name: stands before each message, and its folder is where other files are
/// @throws Error  BadFile: not JSON (with line and column), another version, an unknown key or a
///                wrong value, by its path in the document; parts that need each other
[[nodiscard]] ScenePlan parseScene(const std::string& text, const std::filesystem::path& file);

/// A scene by its file, or a shipped one by its name.
/// @throws Error  BadFile: no such scene (names the shipped ones), or as parseScene
[[nodiscard]] ScenePlan readScene(const std::string& name);

} // namespace palp
