#pragma once

#include "pipeline/formats/images/patient_image.h"
#include "pipeline/process/file_values.h"

#include <filesystem>

class vtkPolyData;

namespace palp
{

/// The values of an image, as its header scales them.
/// @param file    its name, for messages
/// @throws Error  BadFile: several values in a voxel, as of regions that overlap; one is no number
[[nodiscard]] FileValues imageValues(const PatientImage& volume, const std::filesystem::path& file);

/// Those of an array of a surface, at its points or the middles of its triangles.
/// @throws Error  BadFile: no such array, or of several numbers a place; tells which there are; one
///                is no number
[[nodiscard]] FileValues arrayValues(
  vtkPolyData& surface, const std::string& array, const std::filesystem::path& file);

} // namespace palp
