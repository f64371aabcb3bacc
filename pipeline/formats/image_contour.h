#pragma once

#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;
class vtkPolyData;

namespace palp
{

/// The largest connected piece of the surface on which an image has a value, with its hollows,
/// without the stairs of the voxels (windowed sinc, which keeps the volume; Taubin 1996).
///
/// Of a mask the voxels tell only that the surface passes between two of them. Of all that do, the
/// one is taken that bends least, so that terraces of many voxels vanish, too; no point leaves the
/// half voxel to each side within which it is known, and the volume is that of the voxels. A hollow
/// of less than 100 voxels is filled.
///
/// @param mask   whether voxels are in or out, not values between which to interpolate
/// @param notes  gets what was left out
/// @return       triangles [unit of the image], facing lower values; the image's edge cuts it open
[[nodiscard]] vtkSmartPointer<vtkPolyData> imageContour(
  vtkImageData& image, double level, bool mask, std::vector<std::string>& notes);

} // namespace palp
