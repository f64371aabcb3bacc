#pragma once

#include "pipeline/process/file_organs.h"
#include "pipeline/surface_io/length_unit.h"

#include <filesystem>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkPolyData;

namespace palp
{

/// A surface that can be pressed, and what people should know of it.
struct LoadedSurface
{
  vtkSmartPointer<vtkPolyData>
    mesh; ///< [m], triangles only; pointsOf() and trianglesOf() give a Surface
  LengthUnit unit = LengthUnit::Millimeter; ///< that the coordinates of the file were taken in
  bool closed = false;                      ///< every edge has exactly two triangles
  std::string space{};                      ///< of its axes, as in FileSurface
  std::vector<std::string> notes; ///< a line each; the first says size and unit, warnings come last
};

/// Reads a surface, repairs what can be repaired and finds its unit.
///
/// A file that states its unit (as writeSurface does in VTP) is believed; in any other the one
/// unit is taken that gives the size of an organ or a part of one, with a warning. Coincident
/// points are merged, polygons cut into triangles, triangles turned outwards. An open or
/// non-manifold surface loads with a warning.
///
/// @param file    STL, OBJ, PLY, OFF, VTK, VTP or VTU; or an image, in the patient's axes (LPS)
/// @param unit    wins over what the file says
/// @param part    of an image: MetaImage, NIfTI or VTI
/// @throws Error  BadFile: unreadable, or not of its format; BadMesh: nothing to press; BadValue:
///                what the file leaves open and the caller has to say: unit, level, label, series
[[nodiscard]] LoadedSurface readSurface(
  const std::filesystem::path& file, UnitChoice unit = {}, const ImagePart& part = {});

/// What a file holds, as it stands there: read by a process of its own.
/// @throws Error  BadFile: unreadable, or not of its format; BadMesh: no surface in it; BadValue:
///                as readSurface
[[nodiscard]] FileSurface readFileSurface(
  const std::filesystem::path& file, const ImagePart& part = {});

/// The bodies in an image, each as it stands there: read likewise.
///
/// @param part    labels, each a body of its own, all where there are none, those joined by + one
///                body; or a level or band
/// @param isList  whether they are only listed, without surfaces
/// @throws Error  as readFileSurface
[[nodiscard]] FileOrgans readFileOrgans(
  const std::filesystem::path& file, const ImagePart& part, bool isList);

/// The same list, of which only some get their surfaces, so that several processes can read.
/// @param places  of these; none: what is one body alone gets its surface
[[nodiscard]] FileOrgans readFileOrgansAt(
  const std::filesystem::path& file, const ImagePart& part, std::span<const std::size_t> places);

/// What readSurface makes of what a file holds.
/// @param file    its name, for messages
/// @throws Error  BadMesh, BadValue: as readSurface
[[nodiscard]] LoadedSurface madeReady(
  const FileSurface& read, const std::filesystem::path& file, UnitChoice unit = {});

/// Writes a surface in millimeters: VTP with its arrays and unit, or bare STL, PLY, OBJ.
///
/// @param mesh    [m], triangles
/// @param space   of the axes, as "LPS", which stands in the field array, header or comment where
///                3D Slicer looks for it; empty: unknown
/// @source        3D Slicer's vtkMRMLModelStorageNode: SPACE=LPS
/// @throws Error  BadFile: unknown ending, or the file cannot be written
void writeSurface(
  const std::filesystem::path& file, vtkPolyData& mesh, const std::string& space = "");

} // namespace palp
