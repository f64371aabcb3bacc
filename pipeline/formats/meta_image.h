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
  std::array<double, 3> origin{};                 ///< center of the first voxel [unit]
  int type = 0;                                   ///< of a voxel, as VTK numbers them
  std::uintmax_t bytes = 0;                       ///< of all voxels
  std::string unit = "mm";                        ///< "um", "mm" or "cm"
  bool text = false;                              ///< the voxels are numbers in words
  bool bigEndian = false;
  bool compressed = false;
  std::uintmax_t compressedSize = 0; ///< [bytes]; 0: all that follows
  std::filesystem::path dataFile;
  std::uintmax_t begin = 0; ///< of the data in its file [bytes]
};

/// @throws Error  BadFile: not such a header, turned axes, or what is not read here
[[nodiscard]] MetaHeader readMetaHeader(const std::filesystem::path& file);

/// Reads a volume, and every byte of it: VTK's reader takes half of one, or a damaged one, for
/// whole.
///
/// @throws Error  BadFile: as readMetaHeader; cut off; compressed data that are damaged
[[nodiscard]] vtkSmartPointer<vtkImageData> readMetaVolume(
  const std::filesystem::path& file, const MetaHeader& header);

} // namespace palp
