#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

namespace palp
{

constexpr std::uintmax_t kDeflateRatio = 1032; ///< the most that deflate packs into a byte

/// @throws Error  BadFile: cut off, with the sizes [bytes]
[[noreturn]] void refuseCut(
  const std::filesystem::path& file, std::uintmax_t there, std::uintmax_t needed);

/// @param remedy  what to mend in the header
/// @throws Error  BadFile: more data than the header claims, with the sizes [bytes]
[[noreturn]] void refuseMore(const std::filesystem::path& file, std::uintmax_t there,
  std::uintmax_t claimed, const std::string& remedy);

/// Fills all voxels from compressed bytes, zlib's or gzip's, and compares their checksum.
///
/// @param most    of the compressed bytes that may be read
/// @param file    for the message
/// @throws Error  BadFile: cut off, damaged, or more than the voxels
void inflateInto(std::span<unsigned char> voxels, std::istream& in, std::uintmax_t most,
  const std::filesystem::path& file);

} // namespace palp
