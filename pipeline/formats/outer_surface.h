#pragma once

#include <string>
#include <vtkSmartPointer.h>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace palp
{

/// The faces of a volume mesh that belong to one cell only, each turned away from its cell; curved
/// ones in flat pieces.
///
/// Points at the same place are one, so are cells of the same points. What else a grid with volume
/// cells holds (corners, edges, boundary) is left out; a grid without is taken as a surface.
///
/// @param name    stands before the message
/// @throws Error  BadFile: a cell with the wrong number of points, or of points that are not there
[[nodiscard]] vtkSmartPointer<vtkPolyData> outerSurface(
  vtkUnstructuredGrid& grid, const std::string& name);

} // namespace palp
