#include "pipeline/surface_repair.h"

#include "haptics/error.h"
#include "pipeline/poly_data.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vtkCleanPolyData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>

namespace palp
{
namespace
{

std::string counted(std::size_t n, const std::string& one, const std::string& many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

vtkSmartPointer<vtkPolyData> merged(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles)
{
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(makePolyData(points, triangles));
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0.0);
  clean->Update();
  return clean->GetOutput();
}

double area(const std::vector<Eigen::Vector3d>& points, const Triangle& t)
{
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).norm();
}

struct EdgeCount
{
  std::size_t open = 0;    // edges with one triangle
  std::size_t crowded = 0; // edges with more than two
};

EdgeCount countEdges(const std::vector<Triangle>& triangles)
{
  std::vector<std::pair<int, int>> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& t : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      edges.push_back(std::minmax(t[i], t[(i + 1) % 3]));
    }
  }
  std::sort(edges.begin(), edges.end());
  EdgeCount count;
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    count.open += next - edge == 1;
    count.crowded += next - edge > 2;
    edge = next;
  }
  return count;
}

vtkSmartPointer<vtkPolyData> oriented(vtkPolyData& mesh, bool closed)
{
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&mesh);
  normals->SplittingOff();
  normals->ConsistencyOn();
  normals->NonManifoldTraversalOff();
  normals->SetAutoOrientNormals(closed);
  normals->Update();
  return normals->GetOutput();
}

bool sameOrientation(const Triangle& a, Triangle b)
{
  const auto first = std::find(b.begin(), b.end(), a[0]);
  std::rotate(b.begin(), first, b.end());
  return a == b;
}

} // namespace

RepairedSurface repair(std::span<const Eigen::Vector3d> filePoints,
  std::span<const Triangle> fileTriangles, const std::string& name)
{
  RepairedSurface result;
  const auto mesh = merged(filePoints, fileTriangles);
  const auto dropped =
    static_cast<std::size_t>(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines());
  if (dropped > 0)
  {
    result.notes.push_back(
      counted(dropped, "triangle whose corners coincide", "triangles whose corners coincide") +
      " dropped");
    mesh->SetVerts(nullptr);
    mesh->SetLines(nullptr);
  }
  const auto points = pointsOf(*mesh);
  const auto triangles = trianglesOf(*mesh);
  if (std::none_of(triangles.begin(), triangles.end(),
        [&](const Triangle& t) { return area(points, t) > 0.0; }))
  {
    throw Error(ErrorCode::BadMesh, name + ": no triangle has an area; export the surface again");
  }

  const EdgeCount edges = countEdges(triangles);
  result.closed = edges.open == 0 && edges.crowded == 0;
  if (edges.crowded > 0)
  {
    result.warnings.push_back(
      "not a manifold: " + counted(edges.crowded, "edge has", "edges have") +
      " more than two triangles; forces near there may be wrong");
  }
  if (edges.open > 0)
  {
    result.warnings.push_back("open: " + counted(edges.open, "edge has", "edges have") +
      " one triangle only; press it from the front");
  }

  const auto turned = oriented(*mesh, result.closed);
  const auto turnedTriangles = trianglesOf(*turned);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    changed += !sameOrientation(triangles[i], turnedTriangles[i]);
  }
  if (changed > 0)
  {
    result.notes.push_back(counted(changed, "triangle", "triangles") +
      (result.closed ? " turned to face outwards" : " turned to face as their neighbours"));
  }
  result.mesh = makePolyData(points, turnedTriangles);
  return result;
}

} // namespace palp
