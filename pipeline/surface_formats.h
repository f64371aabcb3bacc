#pragma once

#include "pipeline/file_surface.h"

#include <filesystem>
#include <optional>

namespace palp
{

/// Reads STL, OBJ, PLY, OFF, legacy VTK or VTP, by the ending of the name; or the level surface of
/// an image: MetaImage, NIfTI or VTI, in mm.
///
/// Polygons and strips are cut into triangles. For palp-read only: a damaged file may crash the
/// reader or take all memory, and VTK reads numbers by the locale.
///
/// @param level   value of an image on the surface; none for a file that is a surface itself
/// @throws Error  BadFile: missing, not a file, empty, cut off, not of the format its name says;
///                BadMesh: no triangles, a coordinate that is not a number; as levelSurface
[[nodiscard]] FileSurface readFile(
  const std::filesystem::path& file, std::optional<double> level = {});

} // namespace palp
