#pragma once

#include <array>
#include <cstdint>
#include <vector>
#include <vtkType.h>

class vtkImageData;

namespace palp
{

/// What values an image has, as they are stored.
struct ImageValues
{
  double low = 0.0; ///< of those that are finite
  double high = 0.0;
  std::vector<double> distinct; ///< rising; empty: more than 256
  std::vector<vtkIdType> often; ///< how many voxels have each of those
  vtkIdType notFinite = 0;      ///< how many are NaN or infinite
  std::array<int, 3> firstOf{}; ///< these, where
  bool labels = false; ///< three values or more, all whole, most voxels like those beside them
};

/// @param image  one number at each voxel
[[nodiscard]] ImageValues valuesOf(vtkImageData& image);

/// How many voxels are above a level.
[[nodiscard]] vtkIdType voxelsAbove(vtkImageData& image, double level);

/// Edges of the grid whose ends are on different sides of a level: about as many as the points of
/// its surface.
[[nodiscard]] std::uintmax_t crossings(vtkImageData& image, double level);

/// A voxel is 1 where an image has one of these values, else 0; same grid.
[[nodiscard]] std::vector<std::uint8_t> indicator(
  vtkImageData& image, const std::vector<double>& values);

} // namespace palp
