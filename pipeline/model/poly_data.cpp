#include "pipeline/model/poly_data.h"

#include <cassert>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace palp
{

std::vector<Eigen::Vector3d> pointsOf(vtkPolyData& mesh)
{
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(mesh.GetNumberOfPoints()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    mesh.GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

std::vector<Triangle> trianglesOf(vtkPolyData& mesh)
{
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(mesh.GetNumberOfPolys()));
  const auto cells = vtk::TakeSmartPointer(mesh.GetPolys()->NewIterator());
  for (cells->GoToFirstCell(); !cells->IsDoneWithTraversal(); cells->GoToNextCell())
  {
    vtkIdType count = 0;
    const vtkIdType* corner = nullptr;
    cells->GetCurrentCell(count, corner);
    assert(count == 3);
    triangles.push_back(
      { static_cast<int>(corner[0]), static_cast<int>(corner[1]), static_cast<int>(corner[2]) });
  }
  return triangles;
}

vtkSmartPointer<vtkCellArray> makeCells(std::span<const Triangle> triangles)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const auto count = static_cast<vtkIdType>(triangles.size());
  cells->AllocateExact(count, 3 * count);
  for (const auto& [a, b, c] : triangles)
  {
    cells->InsertNextCell({ a, b, c });
  }
  return cells;
}

vtkSmartPointer<vtkPolyData> makePolyData(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  vtkNew<vtkPoints> vertices;
  vertices->SetNumberOfPoints(static_cast<vtkIdType>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    vertices->SetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(vertices);
  mesh->SetPolys(makeCells(triangles));
  return mesh;
}

} // namespace palp
