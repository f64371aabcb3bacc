#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <cstdint>
#include <filesystem>

namespace palp
{

/// VTI, in its own axes, turned about its first voxel as VTK does.
/// @throws Error  BadFile: no values at its points, or several with none marked; fewer or more of
///                them than the extent has
[[nodiscard]] PatientImage readVti(const std::filesystem::path& file);

/// Bytes that the header claims, with the largest number that a voxel may be.
/// @return  0 where it cannot be read
[[nodiscard]] std::uintmax_t vtiBytes(const std::filesystem::path& file);

} // namespace palp
