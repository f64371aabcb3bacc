#pragma once

#include "pipeline/formats/images/nrrd_fields.h"
#include "pipeline/formats/images/patient_image.h"

#include <filesystem>
#include <vector>

namespace palp
{

/// The regions that a header names: Segment0_Name and those beside it, as 3D Slicer writes them.
/// Its older files have a layer of ones for each segment, and tell neither layer nor value.
///
/// @param layers  that the image has
/// @throws Error  BadFile: a layer that is not there, a value that is no number, or two segments of
///                one value
[[nodiscard]] std::vector<Segment> nrrdSegments(
  const std::filesystem::path& file, const NrrdFields& fields, int layers);

} // namespace palp
