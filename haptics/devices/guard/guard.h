#pragma once

#include "haptics/devices/guard/guard_block.h"

#include <chrono>
#include <sys/types.h>

namespace palp
{

/// A process that shares a device's descriptor and sends zero force when this one no longer can:
/// killed, crashed, stopped, swapped out, suspended. Only for devices with motors.
///
/// It acts 3 ms after the last sign of life, or at once where the process has ended. A program
/// that was merely late finds fired() raised.
class Guard
{
public:
  static constexpr auto kLimit = std::chrono::microseconds(3000);

  /// Returns once the guardian watches: no force is to come before.
  /// @param device  its open file, which the guardian gets a copy of
  /// @throws Error  NoDevice: palp-guard is not there, cannot be started, or is silent for 5 s
  Guard(int device, GuardWire wire, const ZeroPacket& zero);

  /// Ends the guardian; the device must have been sent zero.
  ~Guard();

  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

  /// A sign of life.
  /// @realtime  no allocation, no lock, no exception
  void beat() noexcept
  {
    block_->beat = nanoseconds(CLOCK_MONOTONIC);
  }

  /// Whether the motors may hold a force; said before a packet of force and after one of zero.
  /// @realtime  no allocation, no lock, no exception
  void setForced(bool forced) noexcept
  {
    block_->forced = forced ? 1 : 0;
  }

  /// Times that it has ended a force.
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] std::uint32_t fired() const noexcept
  {
    return block_->fired;
  }

  /// Whether the machine is about to be suspended.
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] bool leaving() const noexcept
  {
    return block_->leaving != 0;
  }

  /// False once the guardian itself was killed, and while it is stopped, seen after half a second.
  /// @realtime  no allocation, no lock, no exception
  [[nodiscard]] bool lives() const noexcept;

  [[nodiscard]] const ZeroPacket& zero() const noexcept
  {
    return block_->zero;
  }

private:
  void end() noexcept;

  GuardBlock* block_ = nullptr; // shared memory
  pid_t process_ = -1;
  int link_ = -1; // its other end is the guardian's
};

} // namespace palp
