#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <filesystem>

namespace palp
{

/// A segmentation of DICOM, which holds a mask of single bits for each segment and slice: as a
/// label map, in as many layers as segments that overlap need.
///
/// @throws Error  BadFile: one image of a series; damaged or compressed; of fractions, not masks;
/// of
///                slices that are no grid
/// @source        DICOM PS3.3, A.51 and C.8.20
[[nodiscard]] PatientImage readDicomSegments(const std::filesystem::path& file);

} // namespace palp
