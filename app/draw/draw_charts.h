#pragma once

#include <filesystem>

namespace palp
{

/// Draws what a charts.job in a folder asks for, into charts.png, .svg or .pdf beside it.
/// @throws Error  as writePlots; BadFile: no job of this build
void drawCharts(const std::filesystem::path& folder);

} // namespace palp
