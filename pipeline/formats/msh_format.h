#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// The outer surface of a mesh of Gmsh, MSH 2 or 4, as text or binary; of curved elements their
/// corners.
///
/// @throws Error  BadFile: another version; cut off, damaged, or an element of nodes that are not
///                there; BadMesh: a coordinate that is not finite
/// @source        Gmsh reference manual, "MSH file format"
[[nodiscard]] vtkSmartPointer<vtkPolyData> readMsh(const std::filesystem::path& file);

} // namespace palp
