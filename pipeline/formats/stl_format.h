#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// STL in text or binary form, which its first bytes do not always tell.
/// @throws Error  BadFile: cut off, or no STL; BadMesh: a coordinate that is no usable number
[[nodiscard]] vtkSmartPointer<vtkPolyData> readStl(const std::filesystem::path& file);

} // namespace palp
