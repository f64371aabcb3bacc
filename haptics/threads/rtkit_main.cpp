// palp-rtkit PROCESS THREAD: asks RealtimeKit on the system's bus for real-time priority.
// Exit code 0: granted. Started by askRtkit.

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <string_view>
#include <systemd/sd-bus.h>

namespace
{

constexpr const char* kName = "org.freedesktop.RealtimeKit1";
constexpr const char* kPath = "/org/freedesktop/RealtimeKit1";
constexpr std::uint64_t kPatience = 1'000'000; // [us]
constexpr int kEnough = 20;                    // more would be above what keeps the desktop alive

std::uint64_t numberIn(std::string_view text)
{
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

} // namespace

int main(int count, char** arguments)
{
  if (count != 3)
  {
    return 2;
  }
  sd_bus* opened = nullptr;
  const int failed = sd_bus_open_system(&opened);
  const std::unique_ptr<sd_bus, decltype(&sd_bus_unref)> bus(opened, &sd_bus_unref);
  if (failed < 0)
  {
    return 1;
  }
  sd_bus_set_method_call_timeout(bus.get(), kPatience);
  std::int32_t most = 0;
  if (sd_bus_get_property_trivial(
        bus.get(), kName, kPath, kName, "MaxRealtimePriority", nullptr, 'i', &most) < 0 ||
    most < 1)
  {
    return 1;
  }
  const int granted =
    sd_bus_call_method(bus.get(), kName, kPath, kName, "MakeThreadRealtimeWithPID", nullptr,
      nullptr, "ttu", numberIn(arguments[1]), numberIn(arguments[2]), std::min(most, kEnough));
  return granted < 0 ? 1 : 0;
}
