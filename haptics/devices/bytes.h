#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace palp
{

using Bytes = std::span<const std::byte>;  ///< what came in
using MutableBytes = std::span<std::byte>; ///< what goes out

/// A little-endian integer at an offset that lies inside.
template <std::integral Int>
[[nodiscard]] constexpr Int readInt(Bytes bytes, std::size_t offset) noexcept
{
  std::make_unsigned_t<Int> value = 0;
  for (std::size_t i = 0; i < sizeof(Int); ++i)
  {
    value = static_cast<std::make_unsigned_t<Int>>(value |
      static_cast<std::make_unsigned_t<Int>>(
        std::to_integer<std::make_unsigned_t<Int>>(bytes[offset + i]) << (8 * i)));
  }
  return static_cast<Int>(value);
}

/// Writes a little-endian integer at an offset that lies inside.
template <std::integral Int>
constexpr void writeInt(MutableBytes bytes, std::size_t offset, Int value) noexcept
{
  for (std::size_t i = 0; i < sizeof(Int); ++i)
  {
    bytes[offset + i] =
      static_cast<std::byte>(static_cast<std::make_unsigned_t<Int>>(value) >> (8 * i));
  }
}

/// The nearest integer of a type, clamped to its range; 0 for NaN.
template <std::integral Int>
[[nodiscard]] Int nearestInt(double value) noexcept
{
  if (std::isnan(value))
  {
    return 0;
  }
  return static_cast<Int>(
    std::clamp(std::round(value), static_cast<double>(std::numeric_limits<Int>::min()),
      static_cast<double>(std::numeric_limits<Int>::max())));
}

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF; 0x29B1 over "123456789".
[[nodiscard]] constexpr std::uint16_t crc16(Bytes bytes) noexcept
{
  std::uint16_t crc = 0xFFFF;
  for (const std::byte byte : bytes)
  {
    crc = static_cast<std::uint16_t>(crc ^ (std::to_integer<std::uint16_t>(byte) << 8));
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = static_cast<std::uint16_t>((crc & 0x8000) != 0 ? (crc << 1) ^ 0x1021 : crc << 1);
    }
  }
  return crc;
}

} // namespace palp
