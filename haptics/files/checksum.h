#pragma once

#include <cstdint>
#include <string_view>

namespace palp
{

/// Tells texts apart: against a slip of the hand or the disk, not against intent.
/// @source  FNV-1a of 64 bits: Fowler, Noll, Vo
[[nodiscard]] constexpr std::uint64_t checksumOf(std::string_view bytes) noexcept
{
  std::uint64_t sum = 14695981039346656037U;
  for (const char byte : bytes)
  {
    sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  }
  return sum;
}

} // namespace palp
