#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <cstdint>
#include <filesystem>

namespace palp
{

/// NRRD, as segmentations of 3D Slicer are (.seg.nrrd), with the names of their segments. A
/// component of its voxels for each layer.
///
/// @throws Error  BadFile: not such a header; voxels in another file, in words or packed by bzip2;
///                not three axes of space, or of an unknown one; fewer or more bytes than it
///                claims, or damaged ones
/// @source        teem.sourceforge.net/nrrd/format.html
[[nodiscard]] PatientImage readNrrd(const std::filesystem::path& file);

/// Bytes of the voxels that its header claims.
/// @throws Error  BadFile: as readNrrd
[[nodiscard]] std::uintmax_t nrrdBytes(const std::filesystem::path& file);

} // namespace palp
