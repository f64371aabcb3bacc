#include "app/program/machine.h"

#include <ctime>
#include <fstream>
#include <malloc.h>
#include <nlohmann/json.hpp>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace palp
{

std::string processorName()
{
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with("model name"))
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown";
}

void giveBackLargeBlocks() noexcept
{
  mallopt(M_MMAP_THRESHOLD, 1'000'000);
}

namespace report
{
namespace
{

std::string systemName()
{
  utsname name{};
  uname(&name);
  std::ifstream in("/etc/os-release");
  std::string distribution;
  for (std::string line; std::getline(in, line);)
  {
    if (line.starts_with("PRETTY_NAME=\""))
    {
      distribution = line.substr(13, line.size() - 14) + ", ";
    }
  }
  return distribution + name.sysname + " " + name.release + ", " + name.machine;
}

std::string dateInUtc()
{
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &utc);
  return text;
}

} // namespace

nlohmann::ordered_json describeMachine()
{
  const auto pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  const double gibibytes = pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 30);
  return { { "version", "palp " PALP_VERSION }, { "date", dateInUtc() },
    { "processor", processorName() }, { "cores", std::thread::hardware_concurrency() },
    { "memory_GiB", gibibytes }, { "system", systemName() }, { "compiler", PALP_COMPILER } };
}

} // namespace report
} // namespace palp
