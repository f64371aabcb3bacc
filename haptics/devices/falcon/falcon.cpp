#include "haptics/devices/falcon/falcon.h"

#include <algorithm>

namespace palp
{
namespace
{

// a packet is < and 14 bytes of which each carries a value above this letter and >
constexpr std::byte kFirst{ '<' };
constexpr std::byte kLast{ '>' };
constexpr unsigned kLetter = 'A';
constexpr int kLargestTorque = 4096;
constexpr std::size_t kFlags = 13;

constexpr unsigned valueOf(std::byte letter) noexcept
{
  return (std::to_integer<unsigned>(letter) - kLetter) & 0xFFU;
}

// four nibbles, the least significant first
std::int16_t wordAt(Bytes packet, std::size_t offset) noexcept
{
  unsigned word = 0;
  for (std::size_t i = 0; i < 4; ++i)
  {
    word |= (valueOf(packet[offset + i]) & 0xFU) << (4 * i);
  }
  return static_cast<std::int16_t>(word);
}

FalconState decode(Bytes packet) noexcept
{
  FalconState state;
  for (std::size_t i = 0; i < 3; ++i)
  {
    state.encoder[i] = wordAt(packet, 1 + 4 * i);
  }
  const unsigned flags = valueOf(packet[kFlags]);
  state.buttons = static_cast<std::uint8_t>(flags & 0xFU);
  state.homed = (flags & 0x70U) == 0x70U;
  return state;
}

} // namespace

std::array<std::byte, kFalconPacket> encode(const FalconCommand& command) noexcept
{
  std::array<std::byte, kFalconPacket> packet;
  packet.fill(std::byte{ kLetter });
  packet.front() = kFirst;
  packet.back() = kLast;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const int torque = std::clamp<int>(command.torque[i], -kLargestTorque, kLargestTorque);
    for (std::size_t nibble = 0; nibble < 4; ++nibble)
    {
      const unsigned value = (static_cast<unsigned>(torque) >> (4 * nibble)) & 0xFU;
      packet[1 + 4 * i + nibble] = static_cast<std::byte>(kLetter + value);
    }
  }
  const unsigned flags = (command.homing ? 1U : 0U) | (command.lights & 0xEU);
  packet[kFlags] = static_cast<std::byte>(kLetter + flags);
  return packet;
}

ZeroPacket falconZero() noexcept
{
  ZeroPacket zero{ .size = kFalconPacket, .from = 1, .to = kFlags };
  std::ranges::copy(encode(FalconCommand{ .homing = true }), zero.bytes.begin());
  return zero;
}

std::optional<FalconState> FalconReader::take(Bytes bytes) noexcept
{
  std::optional<FalconState> newest;
  for (const std::byte byte : bytes)
  {
    if (byte == kFirst) // never inside a packet, so this begins one
    {
      filled_ = 0;
    }
    else if (filled_ == 0)
    {
      continue;
    }
    packet_[filled_++] = byte;
    if (filled_ == kFalconPacket)
    {
      if (byte == kLast)
      {
        newest = decode(packet_);
      }
      filled_ = 0;
    }
  }
  return newest;
}

} // namespace palp
