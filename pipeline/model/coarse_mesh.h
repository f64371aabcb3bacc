#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// A surface of fewer triangles, for a picture: one point for each cube of a grid that it goes
/// through, where the planes of the triangles in it meet best; several where it goes through in
/// parts that do not hang together there, as the walls of a shell.
///
/// @param fine       triangles with points in common; stays as it is
/// @param triangles  about as many, above 0; more where a shell is thinner than a cube
/// @source           Lindstrom, "Out-of-core simplification of large polygonal models", SIGGRAPH
///                   2000, with parts; time is linear
[[nodiscard]] vtkSmartPointer<vtkPolyData> coarseMesh(vtkPolyData& fine, int triangles);

} // namespace palp
