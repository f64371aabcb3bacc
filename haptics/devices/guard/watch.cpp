#include "haptics/devices/guard/watch.h"

#include <algorithm>
#include <array>
#include <linux/usbdevice_fs.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr std::int64_t kMillisecond = 1'000'000; // [ns]
constexpr int kLastWords = 10;                   // a packet alone may be lost

void sendZero(const GuardBlock& block, int device) noexcept
{
  // the calls take what they only read as if they wrote it
  auto* bytes = const_cast<std::byte*>(block.zero.bytes.data());
  if (block.wire == GuardWire::File)
  {
    (void)!write(device, bytes, block.zero.size);
    return;
  }
  constexpr unsigned kOut = 0x02;
  constexpr unsigned kPatience = 20; // [ms]
  usbdevfs_bulktransfer transfer{ kOut, static_cast<unsigned>(block.zero.size), kPatience, bytes };
  (void)ioctl(device, USBDEVFS_BULK, &transfer);
}

struct Links
{
  bool dead = false;   // the program
  bool closed = false; // its end of the pipe
};

Links wait(int program, int link, std::int64_t time) noexcept
{
  std::array<pollfd, 2> both{ pollfd{ program, POLLIN, 0 }, pollfd{ link, POLLIN, 0 } };
  const timespec most{ 0, std::clamp<std::int64_t>(time, 0, 900 * kMillisecond) };
  (void)ppoll(both.data(), both.size(), &most, nullptr);
  return { both[0].revents != 0, both[1].revents != 0 };
}

void endForce(const GuardBlock& block, int device) noexcept
{
  for (int i = 0; i < kLastWords; ++i)
  {
    sendZero(block, device);
    const timespec pause{ 0, kMillisecond };
    nanosleep(&pause, nullptr);
  }
}

} // namespace

void watch(GuardBlock& block, int device, int program, int link) noexcept
{
  std::int64_t answered = 0; // silence that has been: the beat before it
  int words = 0;             // zeros sent in it
  std::int64_t asleep = suspendedFor();
  block.guardianBeat = nanoseconds(CLOCK_MONOTONIC);
  block.watched = 1;
  for (std::int64_t pause = block.limit;;)
  {
    block.guardianBeat = nanoseconds(CLOCK_MONOTONIC);
    const Links links = wait(program, link, pause);
    if (links.dead || links.closed)
    {
      if (block.closed == 0)
      {
        endForce(block, device);
      }
      return;
    }
    const std::int64_t beat = block.beat;
    const std::int64_t left = beat + block.limit - nanoseconds(CLOCK_MONOTONIC);
    const std::int64_t slept = suspendedFor();
    const bool suspended = slept - asleep > kSuspended;
    asleep = slept;
    if ((left > 0 || block.forced == 0) && !suspended)
    {
      pause = left > 0 ? std::min(left, block.limit) : kMillisecond;
      continue;
    }
    if (answered != beat || suspended)
    {
      answered = beat;
      words = 0;
      ++block.fired;
    }
    if (words++ < kLastWords)
    {
      sendZero(block, device);
    }
    pause = kMillisecond;
  }
}

} // namespace palp
