#pragma once

#include "haptics/surface/surface.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palp
{

/// What a label of an image means.
struct LabelName
{
  double value;
  std::string name;
};

/// What of an image is the surface.
struct ImagePart
{
  std::optional<double> level{};     ///< its value on the surface
  std::vector<std::string> labels{}; ///< or these regions of a label map together: value or name
  std::string series{};           ///< of several in a folder of DICOM images: place from 1, or UID
  std::vector<LabelName> names{}; ///< of labels, for an image that names none itself
};

/// What a surface file holds, as it stands there.
struct FileSurface
{
  std::vector<Eigen::Vector3d> points; ///< in the unit of the file; finite
  std::vector<Triangle> triangles;     ///< at least one; indices in range
  std::string unit;                    ///< that the file states; empty: none
  std::vector<std::string> notes;      ///< how it was taken, for people; "warning: ..." as well
};

/// Name of the field array by which a VTP or VTK file states its unit: "mm", "cm" or "m".
constexpr const char* kUnitArray = "LengthUnit";

/// @return  bytes for another process on this machine
[[nodiscard]] std::string pack(const FileSurface& surface);

/// @param bytes  of pack
/// @return       nothing where they are not, or name a point that is not there
[[nodiscard]] std::optional<FileSurface> unpack(std::string_view bytes);

} // namespace palp
