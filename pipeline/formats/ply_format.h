#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// Vertices and faces of a PLY file, as text or binary of either byte order; other elements and
/// properties are skipped.
///
/// @throws Error  BadFile: cut off, damaged, or a face of vertices that are not there, by line or
///                element
[[nodiscard]] vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file);

} // namespace palp
