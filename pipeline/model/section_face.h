#pragma once

#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

class vtkAlgorithmOutput;
class vtkPlane;

namespace palp
{

/// The even face in which a plane cuts a closed surface: triangles and their normals, made anew
/// once its output is asked for and one of both has changed.
[[nodiscard]] vtkSmartPointer<vtkPolyDataAlgorithm> sectionFace(
  vtkAlgorithmOutput* surface, vtkPlane& plane);

} // namespace palp
