#pragma once

#include "haptics/contact/surface.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace palp
{

/// What a surface file holds, as it stands there.
struct FileSurface
{
  std::vector<Eigen::Vector3d> points; ///< in the unit of the file; finite
  std::vector<Triangle> triangles;     ///< at least one; indices in range
  std::string unit;                    ///< that the file states; empty: none
};

/// Name of the field array by which a VTP or VTK file states its unit: "mm", "cm" or "m".
constexpr const char* kUnitArray = "LengthUnit";

/// Reads STL, OBJ, PLY, OFF, legacy VTK or VTP, by the ending of the name; or the level surface of
/// an image: MetaImage, NIfTI or VTI, in mm.
///
/// Polygons and strips are cut into triangles. Whatever the file holds, nothing is printed and
/// nothing crashes; numbers are read with a decimal point in every locale.
///
/// @param level   value of an image on the surface; none for a file that is a surface itself
/// @throws Error  BadFile: missing, not a file, empty, cut off, not of the format its name says;
///                BadMesh: no triangles, a coordinate that is not a number; as levelSurface
[[nodiscard]] FileSurface readFile(
  const std::filesystem::path& file, std::optional<double> level = {});

} // namespace palp
