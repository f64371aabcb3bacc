#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// OBJ, its vertices and faces; what else it holds is skipped.
///
/// Of a face each corner is v, v/vt, v//vn or v/vt/vn, counted from 1, or back from the last.
///
/// @throws Error  BadFile: with the line, what was expected there; BadMesh: a coordinate that is
///                not finite
[[nodiscard]] vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file);

} // namespace palp
