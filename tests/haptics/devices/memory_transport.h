#pragma once

#include "haptics/devices/transport.h"

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <vector>

namespace palp::test
{

using Packet = std::vector<std::byte>;

inline Packet packetOf(Bytes bytes)
{
  return { bytes.begin(), bytes.end() };
}

/// A device in memory: answers each packet as it is told, or not.
struct Wire
{
  std::function<void(Bytes)> hear;
  std::deque<Packet> replies;
  std::vector<Packet> heard;
  std::map<int, int> requests; // of the USB chip: the last value of each
  bool gone = false;
  bool silent = false;
};

/// The way to a Wire.
class MemoryTransport final : public SerialTransport
{
public:
  explicit MemoryTransport(Wire& wire)
    : wire_(wire)
  {
  }

  IoResult read(MutableBytes into, std::chrono::microseconds) noexcept override
  {
    if (wire_.gone)
    {
      return { IoCode::Gone, 0 };
    }
    if (wire_.silent || wire_.replies.empty())
    {
      return { IoCode::Timeout, 0 };
    }
    const Packet packet = wire_.replies.front();
    wire_.replies.pop_front();
    const std::size_t size = std::min(into.size(), packet.size());
    std::copy_n(packet.begin(), size, into.begin());
    return { IoCode::Ok, size };
  }

  IoCode write(Bytes bytes) noexcept override
  {
    if (wire_.gone)
    {
      return IoCode::Gone;
    }
    wire_.heard.push_back(packetOf(bytes));
    if (wire_.hear)
    {
      wire_.hear(bytes);
    }
    return IoCode::Ok;
  }

  bool request(std::uint8_t what, std::uint16_t value) noexcept override
  {
    wire_.requests[what] = value;
    if (what == 0 && value == 2) // SIO_TCIFLUSH of libftdi: what nobody has read
    {
      wire_.replies.clear();
    }
    return !wire_.gone;
  }

private:
  Wire& wire_;
};

} // namespace palp::test
