#include "pipeline/model/coarse_mesh.h"

#include "haptics/surface/area_and_volume.h"
#include "pipeline/model/poly_data.h"

#include <cmath>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkQuadricClustering.h>

namespace palp
{

vtkSmartPointer<vtkPolyData> coarseMesh(vtkPolyData& fine, int triangles)
{
  // a plane of any attitude goes through 1.5 cubes an area of their face, with two triangles a cube
  constexpr double kPerFace = 3.0;
  const double side =
    std::sqrt(kPerFace * surfaceArea(pointsOf(fine), trianglesOf(fine)) / triangles);
  vtkNew<vtkQuadricClustering> clusters;
  clusters->SetInputData(&fine);
  clusters->SetAutoAdjustNumberOfDivisions(false);
  clusters->SetDivisionOrigin(fine.GetBounds()[0], fine.GetBounds()[2], fine.GetBounds()[4]);
  clusters->SetDivisionSpacing(side, side, side);
  clusters->CopyCellDataOff();
  clusters->PreventDuplicateCellsOff(); // two that fold onto one another are as none; one is a hole
  clusters->Update();
  return makePolyData(pointsOf(*clusters->GetOutput()), trianglesOf(*clusters->GetOutput()));
}

} // namespace palp
