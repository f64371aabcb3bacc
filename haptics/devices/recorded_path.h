#pragma once

#include "haptics/devices/scripted_path.h"

#include <filesystem>

namespace palp
{

/// Path of the tool in a samples.csv that Palp has exported: its columns time_s, tool_x_mm to
/// tool_z_mm and axis_x to axis_z, wherever they stand.
///
/// @throws Error  BadFile: unreadable, a column that is missing, a row that is none, or a path that
///                ScriptedPath refuses
[[nodiscard]] ScriptedPath readRecording(const std::filesystem::path& file);

} // namespace palp
