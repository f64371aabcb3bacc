#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>
#include <vtkType.h>

class vtkImageData;

namespace palp
{

/// Voxels from one corner to the other, both counted.
struct VoxelBox
{
  std::array<int, 3> low{};
  std::array<int, 3> high{ -1, -1, -1 }; ///< below low: there are none

  [[nodiscard]] bool empty() const noexcept
  {
    return high[0] < low[0];
  }

  /// Takes in what is between two corners.
  void add(const std::array<int, 3>& from, const std::array<int, 3>& to) noexcept;
};

/// What values an image has, as they are stored.
struct ImageValues
{
  double low = 0.0; ///< of those that are finite
  double high = 0.0;
  std::vector<double> distinct; ///< rising; empty: more than 256 that are no labels
  std::vector<vtkIdType> often; ///< how many voxels have each of those
  std::vector<VoxelBox> boxes;  ///< where those are
  vtkIdType notFinite = 0;      ///< how many are NaN or infinite
  std::array<int, 3> firstOf{}; ///< these, where
  bool labels = false; ///< three values or more, all whole, most voxels like those beside them
};

/// @param layer  component of the voxels
[[nodiscard]] ImageValues valuesOf(vtkImageData& image, int layer = 0);

/// How many voxels are above a level.
[[nodiscard]] vtkIdType voxelsAbove(vtkImageData& image, double level);

/// Edges of the grid whose ends are on different sides of a level: about as many as the points of
/// its surface.
[[nodiscard]] std::uintmax_t crossings(vtkImageData& image, double level);

/// Where an image has values that are wanted.
[[nodiscard]] VoxelBox boxWhere(
  vtkImageData& image, const std::function<bool(double)>& isWanted, int layer = 0);

} // namespace palp
