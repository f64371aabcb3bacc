#pragma once

#include "haptics/surface/surface.h"

#include <array>
#include <cstddef>
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

  bool operator==(const LabelName&) const = default;
};

/// What of an image is the surface.
struct ImagePart
{
  std::optional<double> level{};     ///< its value on the surface
  std::vector<std::string> labels{}; ///< or these regions of a label map: value or name
  std::string series{};           ///< of several in a folder of DICOM images: place from 1, or UID
  std::vector<LabelName> names{}; ///< of labels, for an image that names none itself
  std::optional<std::array<double, 2>> band{}; ///< or what has values from the first to the second
  std::size_t components = 1;                  ///< how many pieces of it, the largest first

  static constexpr std::size_t kAllComponents = static_cast<std::size_t>(-1); ///< however many

  bool operator==(const ImagePart&) const = default;
};

/// What a surface file holds, as it stands there.
struct FileSurface
{
  std::vector<Eigen::Vector3d> points; ///< in the unit of the file; finite
  std::vector<Triangle> triangles;     ///< at least one; indices in range
  std::string unit;                    ///< that the file states; empty: none
  std::vector<std::string> notes;      ///< how it was taken, for people; "warning: ..." as well
  std::string space{}; ///< of its axes: "LPS", to the patient's left, back and head; empty: unknown
  double field = 0.0;  ///< longest side of the image whose level it is, in the unit; 0: of none
};

/// Name of the field array by which a VTP or VTK file states its unit: "mm", "cm" or "m".
constexpr const char* kUnitArray = "LengthUnit";

/// Name of the field array, or of the word in a header, by which a file states its axes, as 3D
/// Slicer has it: "LPS" or "RAS".
constexpr const char* kSpaceArray = "SPACE";

/// @return  bytes for another process on this machine
[[nodiscard]] std::string pack(const FileSurface& surface);

/// @param bytes  of pack
/// @return       nothing where they are not, or name a point that is not there
[[nodiscard]] std::optional<FileSurface> unpack(std::string_view bytes);

/// The same as a part of more.
void packSurface(std::string& bytes, const FileSurface& surface);
[[nodiscard]] bool unpackSurface(std::string_view& bytes, FileSurface& surface);

} // namespace palp
