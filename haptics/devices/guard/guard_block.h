#pragma once

#include "haptics/devices/zero_packet.h"

#include <atomic>
#include <cstdint>
#include <ctime>

namespace palp
{

/// How a zero packet goes out through a descriptor.
enum class GuardWire : std::uint32_t
{
  File, ///< write(2): hidraw, a serial line, a socket
  Usb,  ///< a bulk transfer of usbfs to endpoint 2, as the FTDI chip of a Falcon wants
};

/// What a program and its guardian share; times are of CLOCK_MONOTONIC [ns].
///
/// The program writes all but fired, leaving, watched and guardianBeat; each field alone is whole,
/// and no two have to agree.
struct GuardBlock
{
  std::atomic<std::int64_t> beat = 0;         ///< last sign of life
  std::atomic<std::uint32_t> forced = 0;      ///< 1: the motors may hold a force
  std::atomic<std::uint32_t> closed = 0;      ///< 1: ended in order, zero was sent
  std::atomic<std::uint32_t> fired = 0;       ///< times that the guardian ended a force
  std::atomic<std::uint32_t> leaving = 0;     ///< 1: the machine is about to be suspended
  std::atomic<std::uint32_t> watched = 0;     ///< 1: the guardian is there
  std::atomic<std::int64_t> guardianBeat = 0; ///< last sign of life of the guardian
  std::int64_t limit = 0;                     ///< silence that it bears
  GuardWire wire = GuardWire::File;
  ZeroPacket zero;
};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Descriptors that a guardian is born with.
enum GuardDescriptor : int
{
  kGuardBlock = 3,
  kGuardDevice = 4,
  kGuardProgram = 5, ///< a pidfd
  kGuardLink = 6,    ///< end of a pipe whose other end the program alone has
};

/// Of a clock [ns].
/// @realtime  no allocation, no lock, no exception
[[nodiscard]] inline std::int64_t nanoseconds(clockid_t clock) noexcept
{
  timespec now{};
  clock_gettime(clock, &now);
  return std::int64_t{ now.tv_sec } * 1'000'000'000 + now.tv_nsec;
}

/// How long the machine has been suspended since it started [ns].
/// @realtime  no allocation, no lock, no exception
[[nodiscard]] inline std::int64_t suspendedFor() noexcept
{
  return nanoseconds(CLOCK_BOOTTIME) - nanoseconds(CLOCK_MONOTONIC);
}

/// More than two readings of the clocks may differ by, less than any suspend takes [ns].
inline constexpr std::int64_t kSuspended = 50'000'000;

} // namespace palp
