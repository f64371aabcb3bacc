#pragma once

#include <filesystem>
#include <string>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

// What a file holds, read by VTK; see what it says with VtkErrors. The content is not checked
// beyond what VTK's readers pass over in silence. A damaged file may crash them.

/// @throws Error  BadMesh: a coordinate that is not a number, which VTK would take for 0
[[nodiscard]] vtkSmartPointer<vtkPolyData> readObj(const std::filesystem::path& file);

[[nodiscard]] vtkSmartPointer<vtkPolyData> readPly(const std::filesystem::path& file);

/// Polygons, or the outer surface of an unstructured grid.
/// @throws Error  BadMesh: another kind of data
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtk(const std::filesystem::path& file);
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file);

/// The outer surface.
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtu(const std::filesystem::path& file);

/// From now on VTK prints nothing in this process; gives what it would have printed.
class VtkErrors
{
public:
  VtkErrors();

  /// The first error, in one line of printable text; empty when all went well.
  [[nodiscard]] const std::string& first() const noexcept;

private:
  class Log;
  vtkSmartPointer<Log> log_;
};

} // namespace palp
