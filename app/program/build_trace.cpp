#include "app/program/build_trace.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <link.h>
#include <ostream>
#include <sstream>
#include <string_view>
#include <sys/resource.h>
#include <unistd.h>

namespace palp
{
namespace
{

constexpr double kKib = 1024.0; // [B]

double steadyTime()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// since boot, as the kernel counts the start of a process
double sinceStart()
{
  std::ifstream file("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(file)), {});
  std::istringstream fields(text.substr(std::min(text.rfind(')') + 1, text.size())));
  std::string field;
  constexpr int kStartTime = 20; // field 22 of the line, counted after the name in brackets
  for (int i = 0; i < kStartTime; ++i)
  {
    fields >> field;
  }
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double ticks = std::strtod(field.c_str(), nullptr);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
    ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// what no function of the system tells
void readStatus(Footprint& print)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    const auto value = [&] { return std::strtod(line.c_str() + line.find(':') + 1, nullptr); };
    if (line.starts_with("VmRSS:"))
    {
      print.memory = kKib * value();
    }
    else if (line.starts_with("Threads:"))
    {
      print.threads = static_cast<int>(value());
    }
  }
}

double peakMemory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return kKib * static_cast<double>(usage.ru_maxrss);
}

std::vector<std::string> loadedLibraries()
{
  std::vector<std::string> names;
  dl_iterate_phdr(
    [](dl_phdr_info* info, std::size_t, void* list)
    {
      const std::filesystem::path file = info->dlpi_name;
      if (file.has_parent_path()) // else the program, or the kernel's own
      {
        static_cast<std::vector<std::string>*>(list)->push_back(file.filename().string());
      }
      return 0;
    },
    &names);
  return names;
}

struct Family
{
  const char* name;
  std::vector<std::string_view> parts; // of file names
};

const std::array<Family, 4> kFamilies{
  Family{ "Qt", { "libQt" } },
  Family{ "X11/GL", { "libX11", "libxcb", "libGL", "libEGL", "libOpenGL", "libgallium" } },
  Family{ "USB", { "libusb", "libhidapi" } },
  Family{ "VTK", { "libvtk" } },
};

std::string families(const std::vector<std::string>& libraries)
{
  std::ostringstream text;
  for (const Family& family : kFamilies)
  {
    const auto belongs = [&](const std::string& library)
    {
      return std::any_of(family.parts.begin(), family.parts.end(),
        [&](std::string_view part) { return library.starts_with(part); });
    };
    text << (text.tellp() == 0 ? "" : ", ") << family.name << ' '
         << std::count_if(libraries.begin(), libraries.end(), belongs);
  }
  return text.str();
}

double megabytes(double bytes)
{
  return bytes / 1e6;
}

double milliseconds(double seconds)
{
  return 1e3 * seconds;
}

} // namespace

Footprint footprint()
{
  Footprint print;
  print.sinceStart = sinceStart();
  readStatus(print);
  print.peak = peakMemory();
  print.libraries = loadedLibraries();
  return print;
}

BuildTrace::BuildTrace(bool enabled)
  : enabled_(enabled)
{
  if (enabled_)
  {
    const Footprint now = footprint();
    built_.push_back({ "program", "every scene needs it", now.sinceStart, now.memory, now.threads,
      now.libraries.size() });
  }
}

BuildTrace::Booking::Booking(BuildTrace& trace, const char* part, const char* why)
  : trace_(trace)
  , entry_{ .part = part, .why = why }
{
  if (trace_.enabled_)
  {
    before_ = footprint();
    begin_ = steadyTime();
  }
}

BuildTrace::Booking::~Booking()
{
  if (trace_.enabled_)
  {
    entry_.time = steadyTime() - begin_;
    const Footprint after = footprint();
    entry_.memory = after.memory - before_.memory;
    entry_.threads = after.threads - before_.threads;
    entry_.libraries = after.libraries.size() - before_.libraries.size();
    trace_.built_.push_back(entry_);
  }
}

void BuildTrace::skip(const char* part, const char* why, bool leftOut)
{
  if (leftOut)
  {
    leftOut_.emplace_back(part, why);
  }
}

void BuildTrace::write(std::ostream& out) const
{
  constexpr int kName = 22;
  constexpr int kNumber = 11;
  std::ostringstream text;
  text << std::fixed << std::left << std::setw(kName) << "built" << std::right;
  for (const char* column : { "time_ms", "memory_MB", "threads", "libraries" })
  {
    text << std::setw(kNumber) << column;
  }
  text << "  why\n";
  for (const Entry& entry : built_)
  {
    text << std::left << std::setw(kName) << entry.part << std::right << std::setprecision(1)
         << std::setw(kNumber) << milliseconds(entry.time) << std::setw(kNumber)
         << megabytes(entry.memory) << std::setw(kNumber) << entry.threads << std::setw(kNumber)
         << entry.libraries << "  " << entry.why << '\n';
  }
  text << '\n'
       << std::left << std::setw(kName) << "left out"
       << "why\n";
  for (const auto& [part, why] : leftOut_)
  {
    text << std::left << std::setw(kName) << part << why << '\n';
  }
  const Footprint now = footprint();
  text << "\ntotal: " << milliseconds(now.sinceStart) << " ms, peak memory " << megabytes(now.peak)
       << " MB, threads " << now.threads << ", libraries " << now.libraries.size() << " ("
       << families(now.libraries) << ")\n";
  out << text.str();
}

} // namespace palp
