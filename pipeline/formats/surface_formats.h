#pragma once

#include "pipeline/process/file_organs.h"
#include "pipeline/process/file_values.h"

#include <filesystem>

namespace palp
{

/// Reads STL, OBJ, PLY, OFF, legacy VTK, VTP, VTU or MSH, by the ending of the name, of a volume
/// mesh its outer surface; or a surface in an image: MetaImage, NIfTI or VTI.
///
/// Polygons and strips are cut into triangles; a surface whose file says SPACE=RAS is turned to
/// LPS, as 3D Slicer does. For palp-read only: a damaged file may crash the reader or take all
/// memory, and VTK reads numbers by the locale.
///
/// @param part    of an image; none for a file that is a surface itself
/// @throws Error  BadFile: missing, not a file, empty, cut off, not of the format its name says;
///                BadMesh: no triangles, a coordinate that is not a number; as imageSurface
[[nodiscard]] FileSurface readFile(const std::filesystem::path& file, const ImagePart& part = {});

/// The bodies in an image, by imageOrgans.
/// @throws Error  BadFile: a surface, no image; else as readFile
[[nodiscard]] FileOrgans readOrgans(
  const std::filesystem::path& file, const ImagePart& part, bool isList);

/// The values of an image, or of an array of a surface.
/// @param array   its name; empty: the file is an image
/// @throws Error  BadFile: the other kind of file; as imageValues, arrayValues, readFile
[[nodiscard]] FileValues readValues(const std::filesystem::path& file, const std::string& array);

} // namespace palp
