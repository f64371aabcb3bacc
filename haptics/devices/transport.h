#pragma once

#include "haptics/devices/bytes.h"

#include <chrono>

namespace palp
{

enum class IoCode
{
  Ok,
  Timeout, ///< nothing came; the device may still be there
  Gone,    ///< unplugged, or a transfer that failed
};

struct IoResult
{
  IoCode code = IoCode::Gone;
  std::size_t size = 0; ///< bytes read
};

/// A way for bytes to a device and back. Used by one thread at a time.
class Transport
{
public:
  virtual ~Transport() = default;

  /// One report, or one packet.
  [[nodiscard]] virtual IoResult read(
    MutableBytes into, std::chrono::microseconds timeout) noexcept = 0;

  [[nodiscard]] virtual IoCode write(Bytes bytes) noexcept = 0;

  /// The open file behind it, for a guardian to share; -1 where there is none.
  [[nodiscard]] virtual int descriptor() const noexcept
  {
    return -1;
  }
};

/// A serial line behind a USB chip that has requests of its own.
class SerialTransport : public Transport
{
public:
  /// @return  false: refused or gone
  [[nodiscard]] virtual bool request(std::uint8_t what, std::uint16_t value) noexcept = 0;
};

} // namespace palp
