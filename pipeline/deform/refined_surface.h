#pragma once

#include <vtkSmartPointer.h>

class vtkPalpDeformFilter;
class vtkPolyData;

namespace palp
{

/// The pressed surface with the triangles of its dent divided as in its second output, without a
/// gap.
///
/// The points of the surface come first, in their order; arrays Normals, Displacement and Zone.
///
/// @param press  up to date; without its patch, or apart, the surface is as it is
[[nodiscard]] vtkSmartPointer<vtkPolyData> refinedSurface(vtkPalpDeformFilter& press);

} // namespace palp
