#pragma once

#include "haptics/devices/zero_packet.h"

#include <array>
#include <cstdint>
#include <optional>

namespace palp
{

inline constexpr std::size_t kFalconPacket = 16; ///< [bytes], both ways

/// To a Novint Falcon.
struct FalconCommand
{
  std::array<std::int16_t, 3> torque{}; ///< of motors 1 to 3, -4096 to 4096
  bool homing = false;                  ///< asks it to say which axes are homed
  std::uint8_t lights = 0;              ///< bits 1 to 3; their colors differ between sources
};

/// From a Novint Falcon.
struct FalconState
{
  std::array<std::int16_t, 3> encoder{}; ///< of legs 1 to 3 [counts]
  std::uint8_t buttons = 0;              ///< plus, forward, center, minus
  bool homed = false;                    ///< all three axes; only told while homing is asked
};

/// @realtime  pure; no allocation, no lock, no exception
/// @source    libnifalcon/libnifalcon FalconFirmwareNovintSDK.cpp, as facts
[[nodiscard]] std::array<std::byte, kFalconPacket> encode(const FalconCommand& command) noexcept;

/// What ends its force; it still tells whether it is homed.
/// @realtime  pure; no allocation, no lock, no exception
[[nodiscard]] ZeroPacket falconZero() noexcept;

/// Finds packets in what a Falcon sends, however split or joined, and skips what is none.
class FalconReader
{
public:
  /// Takes up bytes, without the two status bytes that the USB chip puts before them.
  /// @return    the newest whole packet, if one was completed
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] std::optional<FalconState> take(Bytes bytes) noexcept;

private:
  std::array<std::byte, kFalconPacket> packet_{};
  std::size_t filled_ = 0;
};

} // namespace palp
