#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// Polygons of an OFF file in text form, which VTK does not read.
///
/// Normals, colors and texture (NOFF, COFF, STOFF, numbers behind a face) are skipped. Each point
/// and each face stands in a line of its own.
///
/// @throws Error  BadFile: names the line, what is wrong with it and what it should be; BadMesh: a
///                coordinate that is not finite
[[nodiscard]] vtkSmartPointer<vtkPolyData> readOff(const std::filesystem::path& file);

} // namespace palp
