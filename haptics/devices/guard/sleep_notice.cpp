#include "haptics/devices/guard/sleep_notice.h"

#include "haptics/files/descriptor.h"

#include <fcntl.h>
#include <memory>
#include <systemd/sd-bus.h>

namespace palp
{
namespace
{

constexpr const char* kName = "org.freedesktop.login1";
constexpr const char* kPath = "/org/freedesktop/login1";
constexpr const char* kManager = "org.freedesktop.login1.Manager";

using Bus = std::unique_ptr<sd_bus, decltype(&sd_bus_flush_close_unref)>;
using Message = std::unique_ptr<sd_bus_message, decltype(&sd_bus_message_unref)>;

struct Notice
{
  GuardBlock& block;
  bool isTold = false; // something is to be done
};

int hear(sd_bus_message* signal, void* at, sd_bus_error* /*error*/)
{
  auto& notice = *static_cast<Notice*>(at);
  int leaves = 0;
  if (sd_bus_message_read(signal, "b", &leaves) >= 0)
  {
    notice.block.leaving = leaves != 0 ? 1 : 0;
    notice.isTold = true;
  }
  return 0;
}

// logind waits for as long as this is open; empty: it does not
Descriptor holdUp(sd_bus* bus)
{
  sd_bus_message* answer = nullptr;
  const int failed = sd_bus_call_method(bus, kName, kPath, kManager, "Inhibit", nullptr, &answer,
    "ssss", "sleep", "Palp", "An arm holds a force", "delay");
  const Message owned(answer, &sd_bus_message_unref);
  int file = -1;
  const bool isHeld = failed >= 0 && sd_bus_message_read(answer, "h", &file) >= 0;
  return Descriptor(isHeld ? fcntl(file, F_DUPFD_CLOEXEC, 0) : -1); // the message closes its own
}

void awaitZero(const GuardBlock& block)
{
  constexpr int kLongest = 200; // [ms]
  for (int i = 0; i < kLongest && block.forced != 0; ++i)
  {
    const timespec millisecond{ 0, 1'000'000 };
    nanosleep(&millisecond, nullptr);
  }
}

} // namespace

void followSleep(GuardBlock& block) noexcept
{
  sd_bus* opened = nullptr;
  if (sd_bus_open_system(&opened) < 0)
  {
    return;
  }
  const Bus bus(opened, &sd_bus_flush_close_unref);
  Notice notice{ block };
  if (sd_bus_match_signal(
        bus.get(), nullptr, kName, kPath, kManager, "PrepareForSleep", hear, &notice) < 0)
  {
    return;
  }
  Descriptor held = holdUp(bus.get());
  while (held || block.leaving != 0)
  {
    notice.isTold = false;
    if (sd_bus_process(bus.get(), nullptr) < 0 ||
      (!notice.isTold && sd_bus_wait(bus.get(), UINT64_MAX) < 0))
    {
      break;
    }
    if (notice.isTold)
    {
      block.leaving != 0 ? awaitZero(block) : void();
      held = block.leaving != 0 ? Descriptor() : holdUp(bus.get());
    }
  }
  block.leaving = 0;
}

} // namespace palp
