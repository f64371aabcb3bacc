// rtkit_double LOG [mute]: stands for RealtimeKit on a bus of its own. It asks of a thread what
// rtkit-daemon asks: that it is one of that process, which limits RLIMIT_RTTIME to 200 ms, and a
// priority of at most 20. Where it grants one, it writes a line to LOG. Mute, it never answers.

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/resource.h>
#include <systemd/sd-bus.h>

namespace
{

struct Desk
{
  std::string log;
  bool isMute = false;
};

int tellMost(sd_bus* /*bus*/, const char* /*path*/, const char* /*interface*/,
  const char* /*property*/, sd_bus_message* reply, void* /*desk*/, sd_bus_error* /*error*/)
{
  return sd_bus_message_append(reply, "i", 20);
}

int grant(sd_bus_message* call, void* at, sd_bus_error* error)
{
  const Desk& desk = *static_cast<Desk*>(at);
  if (desk.isMute)
  {
    return 1;
  }
  std::uint64_t process = 0;
  std::uint64_t thread = 0;
  std::uint32_t priority = 0;
  const int read = sd_bus_message_read(call, "ttu", &process, &thread, &priority);
  const std::string task = "/proc/" + std::to_string(process) + "/task/" + std::to_string(thread);
  rlimit limit{};
  const bool isLimited =
    prlimit(static_cast<pid_t>(process), RLIMIT_RTTIME, nullptr, &limit) == 0 &&
    limit.rlim_max <= 200'000;
  if (read < 0 || priority < 1 || priority > 20 || !isLimited || !std::filesystem::exists(task))
  {
    return sd_bus_error_set_const(error, SD_BUS_ERROR_ACCESS_DENIED, "refused");
  }
  std::ofstream(desk.log, std::ios::app) << process << ' ' << thread << ' ' << priority << '\n';
  return sd_bus_reply_method_return(call, "");
}

const sd_bus_vtable kTable[] = { SD_BUS_VTABLE_START(0),
  SD_BUS_PROPERTY("MaxRealtimePriority", "i", tellMost, 0, SD_BUS_VTABLE_PROPERTY_CONST),
  SD_BUS_METHOD("MakeThreadRealtimeWithPID", "ttu", "", grant, SD_BUS_VTABLE_UNPRIVILEGED),
  SD_BUS_VTABLE_END };

} // namespace

int main(int count, char** arguments)
{
  Desk desk{ .log = arguments[1], .isMute = count > 2 };
  sd_bus* bus = nullptr;
  if (sd_bus_open_system(&bus) < 0 ||
    sd_bus_add_object_vtable(bus, nullptr, "/org/freedesktop/RealtimeKit1",
      "org.freedesktop.RealtimeKit1", kTable, &desk) < 0 ||
    sd_bus_request_name(bus, "org.freedesktop.RealtimeKit1", 0) < 0)
  {
    return 1;
  }
  std::ofstream(desk.log) << "";
  while (sd_bus_process(bus, nullptr) >= 0 && sd_bus_wait(bus, UINT64_MAX) >= 0)
  {
  }
  return 0;
}
