#pragma once

#include "pipeline/process/file_surface.h"

#include <array>

namespace palp
{

/// Values in space that a file holds: at the voxels of an image, or at points of a surface.
struct FileValues
{
  std::array<int, 3> voxels{};           ///< of an image, along its axes; 0: it is a surface
  std::array<double, 12> toSpace{};      ///< from a voxel's place in it, row by row [unit]
  std::vector<Eigen::Vector3d> points{}; ///< of a surface [unit]
  std::vector<float> values{};           ///< of each, the first axis running fastest
  std::vector<LabelName> names{};        ///< of labels, that the file gives
  std::string unit{};                    ///< as in FileSurface
};

/// @return  bytes for another process on this machine
[[nodiscard]] std::string pack(const FileValues& values);

/// @param bytes  of pack
/// @return       nothing where they are not, or not one value stands for each voxel or point
[[nodiscard]] std::optional<FileValues> unpackFileValues(std::string_view bytes);

} // namespace palp
