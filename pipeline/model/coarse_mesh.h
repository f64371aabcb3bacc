#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// A surface of fewer triangles, for a picture: one point for each cube of a grid that it goes
/// through, where the planes of the triangles in it meet best.
///
/// @param fine       triangles; stays as it is
/// @param triangles  about as many, above 0; where the surface is thinner than a cube it may touch
///                   itself
/// @source           Lindstrom, "Out-of-core simplification of large polygonal models", SIGGRAPH
///                   2000, by the toolkit; time is linear
[[nodiscard]] vtkSmartPointer<vtkPolyData> coarseMesh(vtkPolyData& fine, int triangles);

} // namespace palp
