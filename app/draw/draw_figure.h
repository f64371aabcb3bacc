#pragma once

#include <filesystem>

namespace palp
{

/// Draws what a figure.job beside a scene.json asks for, into figure.png beside both.
/// @throws Error  as readExport, checkInputs, loadBodies, loadCalibration, writeFigure; BadFile: no
///                job of this build
void drawFigure(const std::filesystem::path& folder);

} // namespace palp
