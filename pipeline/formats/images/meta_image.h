#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vtkSmartPointer.h>

class vtkImageData;

namespace palp
{

/// The text that a MetaImage begins with, checked.
struct MetaHeader
{
  std::array<int, 3> size{};                      ///< voxels
  std::array<double, 3> spacing{ 1.0, 1.0, 1.0 }; ///< [unit]
  std::array<double, 9> axes{};                   ///< directions in which voxels follow, in turn
  std::array<double, 3> origin{};                 ///< center of the first voxel [unit]
  int type = 0;                                   ///< of a voxel, as VTK numbers them
  std::uintmax_t bytes = 0;                       ///< of all voxels
  std::string unit{};                             ///< "um", "mm" or "cm"; empty: none
  std::string contradiction{};                    ///< of what tells the axes, for people
  double slope = 1.0;                             ///< a value is slope times what is stored,
  double intercept = 0.0;                         ///< plus intercept
  bool text = false;                              ///< the voxels are numbers in words
  bool bigEndian = false;
  bool compressed = false;
  std::uintmax_t compressedSize = 0; ///< [bytes]; 0: all that follows
  std::filesystem::path dataFile;
  std::uintmax_t begin = 0; ///< of the data in its file [bytes]
};

/// @throws Error  BadFile: not such a header, a key given twice, no size of a voxel, axes that span
///                no space, or what is not read here
[[nodiscard]] MetaHeader readMetaHeader(const std::filesystem::path& file);

/// Reads a volume, and every byte of it: VTK's reader takes half of one, or a damaged one, for
/// whole.
///
/// @return        with its corner at 0 and straight axes
/// @throws Error  BadFile: as readMetaHeader; fewer or more data than it claims; compressed data
///                that are damaged
[[nodiscard]] vtkSmartPointer<vtkImageData> readMetaVolume(
  const std::filesystem::path& file, const MetaHeader& header);

} // namespace palp
