#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <filesystem>

namespace palp
{

/// A series of DICOM images as one volume.
///
/// @param folder  that holds the images of the series
/// @param series  its place in the list of those there, from 1, or its UID; empty: the only one
/// @throws Error  BadFile: what is wrong with the series, or with an image of it
[[nodiscard]] PatientImage readDicom(
  const std::filesystem::path& folder, const std::string& series);

} // namespace palp
