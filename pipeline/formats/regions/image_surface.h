#pragma once

#include "pipeline/formats/images/patient_image.h"
#include "pipeline/process/file_organs.h"

#include <string>

namespace palp
{

/// The surface in an image on which it has one value, or of some of its labels together, closed
/// also where the image ends.
///
/// @param part   nothing: refused, with the values that there are
/// @param name   stands before each message
/// @throws Error BadMesh: no level, or none of that value; a level of a label map, whose numbers
///               have no order, or of voxels that are NaN; as chosenLabels, checkVolume, bodyOf
[[nodiscard]] FileSurface imageSurface(
  const PatientImage& volume, const ImagePart& part, const std::string& name);

/// Each of some labels, all where none is named, as a body of its own; or the one of a level or a
/// band of values.
///
/// @param asked   of labels; what is one body alone gets its surface with no place named;
///                one of several that cannot have one is listed, with a warning
/// @throws Error  as imageSurface
[[nodiscard]] FileOrgans imageOrgans(const PatientImage& volume, const ImagePart& part,
  const OrgansAsked& asked, const std::string& name);

} // namespace palp
