// Reads the surface that the argument names and passes it through the dent filter at rest.
#include "pipeline/deform/vtkPalpDeformFilter.h"
#include "pipeline/surface_io/surface_io.h"

#include <cstdio>
#include <vtkNew.h>
#include <vtkPolyData.h>

int main(int, char** arguments)
{
  const palp::LoadedSurface surface = palp::readSurface(arguments[1]);
  vtkNew<vtkPalpDeformFilter> filter;
  filter->SetInputData(surface.mesh);
  filter->Update();
  const auto points = filter->GetOutput()->GetNumberOfPoints();
  std::printf("%lld points, %s\n", points, surface.closed ? "closed" : "open");
  return surface.closed && points == surface.mesh->GetNumberOfPoints() ? 0 : 1;
}
