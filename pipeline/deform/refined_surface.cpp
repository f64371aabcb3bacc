#include "pipeline/deform/refined_surface.h"

#include "pipeline/deform/vtkPalpDeformFilter.h"

#include <algorithm>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

namespace palp
{
namespace
{

// the triangles that the patch draws have a corner within the dent
void addRest(vtkCellArray& from, const PressRegion& region, vtkCellArray& to)
{
  const auto isWithin = [&](vtkIdType point)
  {
    const std::int32_t at = region.find(static_cast<std::int32_t>(point));
    return at >= 0 && region.geodesics()[static_cast<std::size_t>(at)].within;
  };
  const auto cells = vtk::TakeSmartPointer(from.NewIterator());
  vtkNew<vtkIdList> corners;
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    cells->GetCurrentCell(corners);
    if (std::none_of(corners->begin(), corners->end(), isWithin))
    {
      to.InsertNextCell(corners);
    }
  }
}

// the patch begins with the points of the region
void addPatch(vtkCellArray& from, const PressRegion& region, vtkIdType points, vtkCellArray& to)
{
  const auto shared = static_cast<vtkIdType>(region.points().size());
  const auto cells = vtk::TakeSmartPointer(from.NewIterator());
  vtkNew<vtkIdList> corners;
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    cells->GetCurrentCell(corners);
    for (vtkIdType& corner : *corners)
    {
      corner = corner < shared ? region.points()[static_cast<std::size_t>(corner)]
                               : points + corner - shared;
    }
    to.InsertNextCell(corners);
  }
}

} // namespace

vtkSmartPointer<vtkPolyData> refinedSurface(vtkPalpDeformFilter& press)
{
  auto* whole = vtkPolyData::SafeDownCast(press.GetOutputDataObject(0));
  auto* patch = vtkPolyData::SafeDownCast(press.GetOutputDataObject(1));
  const PressRegion& region = press.GetDent().region();
  auto refined = vtkSmartPointer<vtkPolyData>::New();
  if (patch->GetNumberOfPolys() == 0 || region.points().empty())
  {
    refined->ShallowCopy(whole);
    return refined;
  }
  const auto shared = static_cast<vtkIdType>(region.points().size());
  const auto joined = [&](vtkDataArray* all, vtkDataArray* finer)
  {
    auto array = vtk::TakeSmartPointer(finer->NewInstance());
    array->DeepCopy(all);
    array->SetName(all->GetName());
    array->InsertTuples(
      all->GetNumberOfTuples(), finer->GetNumberOfTuples() - shared, shared, finer);
    return array;
  };
  vtkNew<vtkPoints> points;
  points->SetData(joined(whole->GetPoints()->GetData(), patch->GetPoints()->GetData()));
  refined->SetPoints(points);
  vtkPointData* arrays = refined->GetPointData();
  arrays->SetNormals(
    joined(whole->GetPointData()->GetNormals(), patch->GetPointData()->GetNormals()));
  for (const char* name : { "Displacement", "Zone" })
  {
    arrays->AddArray(
      joined(whole->GetPointData()->GetArray(name), patch->GetPointData()->GetArray(name)));
  }
  vtkNew<vtkCellArray> triangles;
  addRest(*whole->GetPolys(), region, *triangles);
  addPatch(*patch->GetPolys(), region, whole->GetNumberOfPoints(), *triangles);
  refined->SetPolys(triangles);
  return refined;
}

} // namespace palp
