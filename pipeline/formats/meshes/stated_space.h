#pragma once

#include "pipeline/process/file_surface.h"

#include <filesystem>
#include <string>
#include <string_view>

class vtkPolyData;

namespace palp
{

/// Keeps what a header or comment says of the axes, SPACE=LPS or SPACE=RAS as 3D Slicer writes it,
/// in the field array of that name.
void stateSpace(vtkPolyData& mesh, std::string_view header);

/// Of axes that a file states: "RAS", "LPS", or empty where it states none.
/// @throws Error  BadFile: other axes of a patient
[[nodiscard]] std::string checkedSpace(
  const std::filesystem::path& file, const std::string& stated);

inline constexpr const char* kTurnedFromRas =
  "turned from axes to right, front and head (SPACE=RAS) to left, back and head (LPS)";

/// Turns 3D Slicer's axes to right, front and head to those to left, back and head.
/// @throws Error  as checkedSpace
void turnToLps(const std::filesystem::path& file, FileSurface& surface);

} // namespace palp
