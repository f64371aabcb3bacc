#include "pipeline/model/section_face.h"

#include <vtkContourTriangulator.h>
#include <vtkCutter.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkTriangleMeshPointNormals.h>

namespace palp
{

vtkSmartPointer<vtkPolyDataAlgorithm> sectionFace(vtkAlgorithmOutput* surface, vtkPlane& plane)
{
  vtkNew<vtkCutter> outline;
  outline->SetInputConnection(surface);
  outline->SetCutFunction(&plane);
  vtkNew<vtkContourTriangulator> filled; // also around holes
  filled->SetInputConnection(outline->GetOutputPort());
  vtkNew<vtkTriangleMeshPointNormals> even; // in the place of the surface's
  even->SetInputConnection(filled->GetOutputPort());
  return even;
}

} // namespace palp
