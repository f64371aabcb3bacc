#include "app/devices_report.h"

#include "app/devices_identify.h"
#include "app/program/devices_options.h"
#include "haptics/devices/driver.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>
#include <vector>

namespace palp
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr int kNoneThere = 3;
constexpr int kNoneUsable = 6;

struct Family
{
  DeviceKind kind;
  const char* name;
  const char* absent;                ///< what to do where none is there
  const char* (*library)() noexcept; ///< what is wrong with the library it needs
};

constexpr std::array kFamilies{
  Family{ DeviceKind::SpaceMouse, "SpaceMouse", "plug one in; it moves the tool, without force",
    &hidUnusableReason },
  Family{ DeviceKind::Falcon, "Novint Falcon",
    "plug in USB and power; the first time give firmware as --device falcon:FILE",
    &usbUnusableReason },
  Family{ DeviceKind::RawHid, "WoodenHaptics, PHD1 and other raw HID boards",
    "plug one in; use it by its path, as --device wooden:/dev/hidraw2", &hidUnusableReason },
};

void print(const FoundDevice& device)
{
  std::cout << "  " << device.name << " (" << device.ids << ") at " << device.path << ": "
            << (device.unusableReason.empty() ? "can be used" : device.unusableReason) << '\n';
}

// a Falcon that can be opened may still lack its firmware: only its answer tells
void probeFirmware(FoundDevice& device)
{
  if (device.kind == DeviceKind::Falcon && device.unusableReason.empty())
  {
    try
    {
      (void)openDriver("falcon");
    }
    catch (const Error& error)
    {
      const std::string what = error.what(); // begins with the name
      device.unusableReason = what.substr(what.find(": ") + 2);
    }
  }
}

// spacenavd and its clients agree on this name
bool spacenavdRuns()
{
  const char* socket = std::getenv("SPNAV_SOCKET"); // NOLINT(concurrency-mt-unsafe): nobody sets it
  return std::filesystem::exists(socket != nullptr ? socket : "/run/spnav.sock");
}

int list(std::vector<FoundDevice> all)
{
  std::ranges::for_each(all, probeFirmware);
  for (const auto& [kind, name, absent, library] : kFamilies)
  {
    std::cout << name << ": protocol tested against an emulation; not yet on hardware\n";
    const auto isOurs = [kind = kind](const FoundDevice& one) { return one.kind == kind; };
    if (std::ranges::none_of(all, isOurs))
    {
      const std::string broken = library();
      std::cout << "  none; " << (broken.empty() ? absent : broken) << '\n';
    }
    for (const FoundDevice& device : all)
    {
      if (isOurs(device))
      {
        print(device);
      }
    }
  }
  if (spacenavdRuns())
  {
    std::cout << "spacenavd runs and may hold the SpaceMouse; give --device spacenavd then\n";
  }
  if (all.empty())
  {
    return kNoneThere;
  }
  const bool usable =
    std::ranges::any_of(all, [](const auto& one) { return one.unusableReason.empty(); });
  return usable ? 0 : kNoneUsable;
}

int probe(const std::string& name)
{
  const std::unique_ptr<Driver> driver = openDriver(name);
  std::vector<double> times; // [us]
  int answered = 0;
  DriverSample sample;
  for (const auto end = Clock::now() + 1s; Clock::now() < end;)
  {
    const auto begin = Clock::now();
    const IoCode code = driver->tick(Eigen::Vector3d::Zero(), 0.001, sample);
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begin).count());
    answered += code == IoCode::Ok ? 1 : 0;
    if (code == IoCode::Gone)
    {
      std::cout << driver->limits().model << ": went away while it was probed; check its cable\n";
      return kNoneUsable;
    }
    std::this_thread::sleep_until(begin + 1ms);
  }
  const Statistics statistics = statisticsOf(times);
  std::cout << driver->limits().model << ": " << answered << " of " << times.size()
            << " exchanges answered in a second; median " << std::lround(statistics.median)
            << " us, longest " << std::lround(statistics.high) << " us"
            << (sample.homed ? "" : "; not homed yet") << (sample.stopped ? "; stopped" : "");
  if (sample.temperature > 0.0)
  {
    std::cout << "; motors at " << sample.temperature << " deg C";
  }
  std::cout << '\n';
  return answered > 0 ? 0 : kNoneUsable;
}

// until the user ends the program
[[noreturn]] void watch()
{
  const auto onSamePath = [](const FoundDevice& a)
  { return [&a](const FoundDevice& b) { return a.path == b.path && a.ids == b.ids; }; };
  for (std::vector<FoundDevice> before = findDevices();; std::this_thread::sleep_for(500ms))
  {
    const std::vector<FoundDevice> now = findDevices();
    for (const FoundDevice& one : now)
    {
      if (std::ranges::none_of(before, onSamePath(one)))
      {
        std::cout << "plugged in:\n";
        print(one);
      }
    }
    for (const FoundDevice& one : before)
    {
      if (std::ranges::none_of(now, onSamePath(one)))
      {
        std::cout << "unplugged: " << one.name << " at " << one.path << '\n';
      }
    }
    std::cout.flush();
    before = now;
  }
}

} // namespace

int showDevices(const DevicesOptions& options)
{
  if (!options.identify.empty())
  {
    return identifyDevice(options.identify, options.added);
  }
  if (!options.home.empty())
  {
    return homeDevice(options.home);
  }
  if (!options.probe.empty())
  {
    return probe(options.probe);
  }
  const int code = list(findDevices());
  if (options.watch)
  {
    std::cout.flush();
    watch();
  }
  return code;
}

} // namespace palp
