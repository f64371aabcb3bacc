#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <cstdint>
#include <filesystem>

namespace palp
{

// Images, each in the patient's axes: x to the left, y to the back, z to the head (LPS), where its
// format knows them. As in vtk_formats.h: a damaged file may crash a reader of VTK.

/// MetaImage, whose axes are the patient's as ITK and Slicer write it, its value scaled by the
/// header.
/// @throws Error  as readMetaHeader and readMetaVolume
[[nodiscard]] PatientImage readMetaImage(const std::filesystem::path& file);

/// NIfTI, its value scaled and its unit taken by the header.
/// @throws Error  BadFile: of more or fewer bytes than it has; as readNiftiHeader; no number to
///                scale by
[[nodiscard]] PatientImage readNifti(const std::filesystem::path& file);

/// Gives an image the true sides of its voxels as spacing, where its matrix has them: what is known
/// between voxels goes by them.
/// @throws Error  BadFile: they are no lengths
void takeSides(const std::filesystem::path& file, PatientImage& volume);

/// Bytes of the voxels that the header of an image claims; 0 where it cannot be read.
[[nodiscard]] std::uintmax_t claimedBytes(const std::filesystem::path& file) noexcept;

} // namespace palp
