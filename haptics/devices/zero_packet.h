#pragma once

#include "haptics/devices/bytes.h"

#include <algorithm>
#include <array>

namespace palp
{

/// A command of a device's protocol that ends all force, as it stands on the wire.
struct ZeroPacket
{
  static constexpr std::size_t kLargest = 512;

  std::array<std::byte, kLargest> bytes{};
  std::size_t size = 0;
  std::size_t from = 0; ///< first byte of the force in it
  std::size_t to = 0;   ///< behind its last; the others may differ from command to command
};

/// Whether a command of the same protocol asks for force.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] inline bool asksForForce(Bytes command, const ZeroPacket& zero) noexcept
{
  const Bytes rest(zero.bytes);
  return command.size() != zero.size ||
    !std::ranges::equal(command.subspan(zero.from, zero.to - zero.from),
      rest.subspan(zero.from, zero.to - zero.from));
}

} // namespace palp
