#pragma once

#include "haptics/devices/transport.h"
#include "haptics/devices/zero_packet.h"

#include <array>
#include <memory>

namespace palp
{

/// The words of a WoodenHaptics board as its makers' serial firmware writes them: a line of seven
/// decimal numbers each way. To its driver it is the board with reports of 14 bytes.
/// @source  forsslund/haptikfabrikenapi, src/fsusbhapticdevicethread.h, toChars
class WoodenText final : public Transport
{
public:
  explicit WoodenText(std::unique_ptr<Transport> line);

  [[nodiscard]] IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept override;
  [[nodiscard]] IoCode write(Bytes bytes) noexcept override;
  [[nodiscard]] int descriptor() const noexcept override
  {
    return line_->descriptor();
  }

private:
  [[nodiscard]] bool takeLine(MutableBytes into) noexcept;

  static constexpr std::size_t kLongest = 49; // of seven times -32768 and a space

  std::unique_ptr<Transport> line_;
  std::array<char, 256> text_{}; // read, not yet taken
  std::size_t filled_ = 0;
};

/// What ends its force, as it stands on the wire.
[[nodiscard]] ZeroPacket woodenTextZero() noexcept;

} // namespace palp
