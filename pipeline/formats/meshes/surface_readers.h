#pragma once

#include <filesystem>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

// What a file holds, in the formats that are read here and not by VTK.

/// STL in text or binary form, which its first bytes do not always tell.
/// @throws Error  BadFile: cut off, or no STL; BadMesh: a coordinate that is no usable number
[[nodiscard]] vtkSmartPointer<vtkPolyData> readStl(const std::filesystem::path& file);

/// OBJ, its vertices and faces; what else it holds is skipped.
///
/// Of a face each corner is v, v/vt, v//vn or v/vt/vn, counted from 1, or back from the last.
///
/// @throws Error  BadFile: with the line, what was expected there; BadMesh: a coordinate that is
///                not finite
[[nodiscard]] vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file);

/// Vertices and faces of a PLY file, as text or binary of either byte order; other elements and
/// properties are skipped.
///
/// @throws Error  BadFile: cut off, damaged, or a face of vertices that are
///                not there, by line or element
[[nodiscard]] vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file);

/// Polygons of an OFF file in text form, which VTK does not read.
///
/// Normals, colors and texture (NOFF, COFF, STOFF, numbers behind a face) are skipped. Each point
/// and each face stands in a line of its own.
///
/// @throws Error  BadFile: names the line, what is wrong with it and what it should be; BadMesh: a
///                coordinate that is not finite
[[nodiscard]] vtkSmartPointer<vtkPolyData> readOff(const std::filesystem::path& file);

} // namespace palp
