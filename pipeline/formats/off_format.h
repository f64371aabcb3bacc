#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// Polygons of an OFF file in text form, which VTK does not read.
///
/// Normals and colours (NOFF, COFF, numbers behind a face) are skipped.
///
/// @throws Error  BadFile: names the line, what is wrong with it and what it should be
[[nodiscard]] vtkSmartPointer<vtkPolyData> readOff(const std::filesystem::path& file);

} // namespace palp
