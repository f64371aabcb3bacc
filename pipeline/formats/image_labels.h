#pragma once

#include "pipeline/formats/images/patient_image.h"

#include <string>
#include <vector>

namespace palp
{

/// The labels of an image for people: value, name, voxels and volume of each.
/// @param volume  a label map, or segments in layers
[[nodiscard]] std::string labelsInWords(const PatientImage& volume);

/// An image on the same grid that is 1 where one of some labels is, else 0.
///
/// @param labels  values, or names of segments, with or without capitals
/// @param name    stands before each message
/// @throws Error  BadMesh: none of that value or name, or several, as in layers; says which there
///                are; fewer than 8 voxels; labels beyond 2^53
[[nodiscard]] vtkSmartPointer<vtkImageData> maskOfLabels(
  const PatientImage& volume, const std::vector<std::string>& labels, const std::string& name);

} // namespace palp
