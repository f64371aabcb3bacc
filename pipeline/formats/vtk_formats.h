#pragma once

#include <filesystem>
#include <string>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

// What a file holds, read by VTK; what it complains of it throws as VtkError. The content is not
// checked beyond what VTK's readers pass over in silence. A damaged file may crash them.

/// Text of an XML file of VTK, up to the data that are appended.
/// @throws Error  BadFile: without its last tag, of another kind, or of arrays no file can have
[[nodiscard]] std::string checkedXml(const std::filesystem::path& file);

/// Polygons, or the outer surface of an unstructured grid.
/// @throws Error  BadMesh: another kind of data
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtk(const std::filesystem::path& file);
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtp(const std::filesystem::path& file);

/// The outer surface.
[[nodiscard]] vtkSmartPointer<vtkPolyData> readVtu(const std::filesystem::path& file);

/// What VTK reports, in one line of printable text.
struct VtkError
{
  std::string text;
};

/// From now on VTK prints nothing in this process: its first error, in any object, is thrown. What
/// VTK does after an error may crash, and the objects at work are lost, so this is for a process
/// that ends soon.
void throwVtkErrors();

} // namespace palp
