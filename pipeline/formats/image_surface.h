#pragma once

#include "pipeline/formats/image_formats.h"
#include "pipeline/process/file_surface.h"

class vtkPolyData;

namespace palp
{

/// Surface on which an image has one value, or of some of its labels, by imageContour. An image of
/// two values is taken at their middle, whatever level lies between them.
///
/// @param part   nothing: refused, with the values that there are
/// @param name   stands before each message
/// @param notes  gets how it was taken
/// @return       triangles [unit of the image]; the image's edge cuts the surface open
/// @throws Error BadMesh: no level, or none of that value; a level of a label map, whose numbers
///               have no order, or of voxels that are NaN; axes that span no space; no volume;
///               several values a voxel; more than 10 million triangles
[[nodiscard]] vtkSmartPointer<vtkPolyData> imageSurface(const PatientImage& volume,
  const ImagePart& part, const std::string& name, std::vector<std::string>& notes);

} // namespace palp
