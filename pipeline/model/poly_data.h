#pragma once

#include "haptics/surface/surface.h"

#include <span>
#include <vector>
#include <vtkSmartPointer.h>

class vtkCellArray;
class vtkPolyData;

namespace palp
{

/// @param mesh  triangles
/// @return      points of the mesh, in its unit
[[nodiscard]] std::vector<Eigen::Vector3d> pointsOf(vtkPolyData& mesh);

/// @param mesh  triangles only, which is checked by assertion
[[nodiscard]] std::vector<Triangle> trianglesOf(vtkPolyData& mesh);

/// @param triangles  indices of points
[[nodiscard]] vtkSmartPointer<vtkCellArray> makeCells(std::span<const Triangle> triangles);

/// Triangles for VTK, with points in single precision.
[[nodiscard]] vtkSmartPointer<vtkPolyData> makePolyData(
  std::span<const Eigen::Vector3d> points, std::span<const Triangle> triangles);

} // namespace palp
