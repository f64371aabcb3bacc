#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>

namespace palp
{

constexpr std::uintmax_t kDeflateRatio = 1032; ///< the most that deflate packs into a byte

/// @throws Error  BadFile: cut off, with the sizes [bytes]
[[noreturn]] void refuseCut(
  const std::filesystem::path& file, std::uintmax_t there, std::uintmax_t needed);

/// Fills all voxels from compressed bytes, zlib's or gzip's, and compares their checksum.
///
/// @param most    of the compressed bytes that may be read
/// @param file    for the message
/// @throws Error  BadFile: cut off, damaged, or more than the voxels
void inflateInto(std::span<unsigned char> voxels, std::istream& in, std::uintmax_t most,
  const std::filesystem::path& file);

} // namespace palp
