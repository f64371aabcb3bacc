#pragma once

#include <cstdint>
#include <filesystem>

namespace palp
{

/// What a NIfTI file begins with, checked, as far as VTK's reader does not.
struct NiftiHeader
{
  std::uintmax_t begin = 0; ///< of the voxels, in the file or in what it unpacks to [bytes]
  std::uintmax_t bytes = 0; ///< of the voxels
  bool packed = false;      ///< with gzip, whatever the name
};

/// @throws Error  BadFile: not such a header, or of what is not read here
[[nodiscard]] NiftiHeader readNiftiHeader(const std::filesystem::path& file);

/// @throws Error  BadFile: fewer bytes of voxels than the header claims, as far as a packed file
///                tells, or more
void checkNiftiLength(const std::filesystem::path& file, const NiftiHeader& header);

} // namespace palp
