#pragma once

#include "haptics/surface/tree/box_tree.h"

#include <Eigen/Geometry>
#include <string>
#include <vector>

class vtkImageData;

namespace palp
{

/// A closed surface between the voxels of an image.
struct ImageContour
{
  std::vector<Eigen::Vector3d> points; ///< [unit of the image]
  std::vector<Triangle> triangles;     ///< facing lower values
  std::vector<Eigen::Vector3d> from;   ///< where each point was before stairs were smoothed
  double enclosed = 0.0;               ///< volume that was meant to stay [unit^3]
  double largest = 0.0;                ///< that of its largest piece [unit^3]
};

/// The largest connected pieces of the surface on which an image has a value, with their hollows,
/// without the stairs of the voxels (windowed sinc, Taubin 1996, whose toll of the volume is given
/// back where it was taken).
///
/// Of a mask the voxels tell only that the surface passes between two of them. One is taken that
/// bends little over some ten voxels, so that terraces as wide vanish, too (wider ones stay); no
/// point leaves the half voxel to each side within which it is known, and the volume is that of the
/// voxels. A hollow of less than 100 voxels is filled, with what lies in it.
///
/// @param image       nowhere above the level at its border, or everywhere
/// @param isMask      of two values, with the level in their middle; else there are values between
///                    which to interpolate
/// @param field       box about all voxels' middles that were measured: a face of a mask beyond it
///                    closes the body there, and stays flat [unit of the image]
/// @param components  how many pieces at most, the largest first
/// @param notes       gets what was left out
[[nodiscard]] ImageContour imageContour(vtkImageData& image, double level, bool isMask,
  const Eigen::AlignedBox3d& field, std::size_t components, std::vector<std::string>& notes);

} // namespace palp
