#pragma once

#include "pipeline/process/file_surface.h"

#include <filesystem>
#include <string_view>

class vtkPolyData;

namespace palp
{

/// Keeps what a header or comment says of the axes, SPACE=LPS or SPACE=RAS as 3D Slicer writes it,
/// in the field array of that name.
void stateSpace(vtkPolyData& mesh, std::string_view header);

/// Turns 3D Slicer's axes to right, front and head to those to left, back and head.
/// @throws Error  BadFile: it states other axes of a patient
void turnToLps(const std::filesystem::path& file, FileSurface& surface);

} // namespace palp
