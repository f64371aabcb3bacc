#pragma once

#include "pipeline/formats/regions/image_values.h"

#include <functional>
#include <vtkSmartPointer.h>

namespace palp
{

/// An image of 0 that holds a box of another's voxels and one more to each side, also beyond its
/// border.
[[nodiscard]] vtkSmartPointer<vtkImageData> maskAbout(vtkImageData& image, const VoxelBox& box);

/// Sets to 1 what is wanted of the voxels in a box.
/// @param mask  of maskAbout with the same box
void mark(vtkImageData& mask, vtkImageData& image, const VoxelBox& box,
  const std::function<bool(double)>& isWanted, int layer = 0);

/// The image with one more voxel to each side, so that a surface ends there; itself where its
/// border is above the level nowhere, or everywhere, as of a distance.
/// @param outside  of those voxels, below the level
[[nodiscard]] vtkSmartPointer<vtkImageData> closedAtBorder(
  vtkImageData& image, double level, double outside);

/// Whether the border is above the level, as of a distance: the body is below then.
/// @param image  of closedAtBorder, or a mask
[[nodiscard]] bool isAboveAround(vtkImageData& image, double level);

} // namespace palp
