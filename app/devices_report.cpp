#include "app/devices_report.h"

#include "app/devices_identify.h"
#include "app/program/devices_options.h"
#include "haptics/devices/driver.h"
#include "haptics/devices/forcedimension/forcedimension_driver.h"
#include "haptics/devices/haply/haply_driver.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/open_device.h"
#include "haptics/error.h"
#include "haptics/numerics/statistics.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
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

// what is wrong with a device, by the refusal of what needs it; empty: nothing
template <typename Need>
std::string unusableReasonOf(const Need& need)
{
  try
  {
    need();
    return "";
  }
  catch (const Error& error)
  {
    const std::string what = error.what(); // begins with the name
    return what.substr(what.find(": ") + 2);
  }
}

std::string unusableReasonOf(const char* name)
{
  return unusableReasonOf([name] { (void)openDriver(name); });
}

struct Family
{
  std::optional<DeviceKind> kind; ///< none: it is not plugged in, but a program or a library
  const char* name;
  const char* device; ///< as --device takes it
  const char* needs;
  const char* state; ///< what to do where none is plugged in; of the others, where one is there
  std::string (*unusable)(); ///< why none can be used whatever is plugged in, and what to do
  bool isHeld = false;       ///< not plugged in, but where nothing is wrong, a device is there
};

const std::array kFamilies{
  Family{ DeviceKind::SpaceMouse, "SpaceMouse", "spacemouse[:PATH]", "hidapi, udev rules",
    "plug one in; it moves the tool, without force",
    [] { return std::string(hidUnusableReason()); } },
  Family{ DeviceKind::Gamepad, "game pads", "gamepad[:PATH]",
    "a seat at the machine or group input",
    "plug one in; its sticks move the tool, and it rumbles as the force does",
    [] { return std::string(); } },
  Family{ DeviceKind::Falcon, "Novint Falcon", "falcon[:FIRMWARE]", "libusb, udev rules, firmware",
    "plug in USB and power; the first time give firmware as --device falcon:FILE",
    [] { return std::string(usbUnusableReason()); } },
  Family{ DeviceKind::RawHid, "WoodenHaptics, PHD1 and other raw HID boards",
    "wooden:PATH[,ARM], phd1:PATH", "hidapi, udev rules",
    "plug one in; use it by its path, as --device wooden:/dev/hidraw2",
    [] { return std::string(hidUnusableReason()); } },
  Family{ DeviceKind::Serial, "WoodenHaptics and Polhem in lines of text", "wooden:PATH[,ARM]",
    "group dialout", "plug one in; use it by its path, as --device wooden:/dev/ttyACM0",
    [] { return std::string(); } },
  Family{ {}, "six-axis mice through spacenavd", "spacenavd", "libspnav, spacenavd",
    "spacenavd runs and may hold the SpaceMouse; give --device spacenavd then",
    [] { return unusableReasonOf("spacenavd"); }, true },
  Family{ {}, "Haply Inverse3", "haply[:PORT]", "libwebsockets, the makers' service",
    "its service knows one: can be used", [] { return unusableReasonOf([] { findHaply(); }); },
    true },
  Family{ {}, "Force Dimension omega, delta, sigma, lambda", "forcedimension[:LIBRARY]",
    "libdrd of the makers' SDK 3",
    "libdrd is there; palp devices --probe forcedimension tells whether an arm is",
    [] { return unusableReasonOf(requireForceDimension); } },
  Family{ {}, "OpenIGTLink trackers", "openigtlink[:ADDRESS:PORT][,TOOL]",
    "libopenigtlink, a tracker that sends",
    "port 18944 is free; a tracker has to connect once the window listens",
    [] { return unusableReasonOf("openigtlink"); } },
};

void print(const FoundDevice& device)
{
  std::cout << "  " << device.name << (device.ids.empty() ? "" : " (" + device.ids + ")") << " at "
            << device.path << ": "
            << (device.unusableReason.empty() ? "can be used" : device.unusableReason) << '\n';
}

// a Falcon that can be opened may still lack its firmware: only its answer tells
void probeFirmware(FoundDevice& device)
{
  if (device.kind == DeviceKind::Falcon && device.unusableReason.empty())
  {
    device.unusableReason = unusableReasonOf("falcon");
  }
}

// what is not plugged in: its program or library
bool printState(const Family& family)
{
  const std::string reason = family.unusable();
  std::cout << "  " << (reason.empty() ? family.state : "none; " + reason) << '\n';
  return family.isHeld && reason.empty();
}

void printPlugged(const Family& family, const std::vector<FoundDevice>& all)
{
  const auto isOurs = [&](const FoundDevice& one) { return one.kind == family.kind; };
  if (std::ranges::none_of(all, isOurs))
  {
    const std::string broken = family.unusable();
    std::cout << "  none; " << (broken.empty() ? family.state : broken) << '\n';
  }
  for (const FoundDevice& device : all)
  {
    if (isOurs(device))
    {
      print(device);
    }
  }
}

int list(std::vector<FoundDevice> all)
{
  std::ranges::for_each(all, probeFirmware);
  bool usable =
    std::ranges::any_of(all, [](const auto& one) { return one.unusableReason.empty(); });
  for (const Family& family : kFamilies)
  {
    std::cout << family.name << " (--device " << family.device << "): needs " << family.needs
              << '\n';
    if (family.kind)
    {
      printPlugged(family, all);
    }
    else
    {
      usable = printState(family) || usable;
    }
  }
  std::cout << "Each protocol was tested against an emulation, none yet on hardware\n";
  return usable ? 0 : all.empty() ? kNoneThere : kNoneUsable;
}

struct Probed
{
  std::vector<double> times; ///< of exchanges [us]
  int answered = 0;
  Clock::time_point heard; ///< the last of these
  bool isGone = false;
  double leap = 0.0; ///< farther than a hand takes an arm between two answers [m]
  DriverSample sample;
};

// 0: as fast as an arm can go; homing sets where it is
double leapOf(const DriverSample& from, const DriverSample& to, Clock::duration passed)
{
  constexpr double kFastestHand = 5.0; // [m/s]
  constexpr double kJitter = 0.002;    // [m]
  const double went = (to.position - from.position).norm();
  const double most = kJitter + kFastestHand * std::chrono::duration<double>(passed).count();
  return from.homed == to.homed && went > most ? went : 0.0;
}

// exchanges of a second
Probed exchangesOf(Driver& driver)
{
  Probed probed;
  for (const auto end = Clock::now() + 1s; Clock::now() < end && !probed.isGone;)
  {
    const auto begin = Clock::now();
    const DriverSample before = probed.sample;
    const IoCode code = driver.tick(Eigen::Vector3d::Zero(), 0.001, probed.sample);
    const auto now = Clock::now();
    if (code == IoCode::Ok && probed.answered > 0 && driver.limits().rendersForce)
    {
      probed.leap = std::max(probed.leap, leapOf(before, probed.sample, now - probed.heard));
    }
    probed.times.push_back(std::chrono::duration<double, std::micro>(now - begin).count());
    probed.answered += code == IoCode::Ok ? 1 : 0;
    probed.heard = code == IoCode::Ok ? now : probed.heard;
    probed.isGone = code == IoCode::Gone;
    std::this_thread::sleep_until(begin + 1ms);
  }
  return probed;
}

// why a device that was probed cannot be used, and what to do; empty: it can
std::string unusableReasonOf(const Probed& probed, const std::string& name)
{
  constexpr auto kSilent = 200ms;
  if (probed.isGone)
  {
    return name.starts_with("haply") || name.starts_with("spacenavd")
      ? "went away while it was probed, or told what no device is; check that its service still "
        "runs, knows it, and tells positions in meters"
      : "went away while it was probed; check its cable";
  }
  if (probed.answered == 0)
  {
    return "answered none of " + std::to_string(probed.times.size()) +
      " exchanges in its own protocol; check its path, power, cable and firmware";
  }
  if (Clock::now() - probed.heard > kSilent)
  {
    return "fell silent after " + std::to_string(probed.answered) + " exchanges; check its power";
  }
  if (probed.leap > 0.0)
  {
    return "its position leaps by " + std::to_string(std::lround(1e3 * probed.leap)) +
      " mm; check the encoders, their cables and the configuration";
  }
  return name.starts_with("openigtlink") && !probed.sample.homed
    ? "no tracker has sent a pose; start one that connects to this port and sends TRANSFORM or "
      "POSITION"
    : "";
}

int probe(const std::string& name)
{
  const std::unique_ptr<Driver> driver = openDriver(name);
  const Probed probed = exchangesOf(*driver);
  std::cout << driver->limits().model << ": ";
  if (const std::string reason = unusableReasonOf(probed, name); !reason.empty())
  {
    std::cout << reason << '\n';
    return kNoneUsable;
  }
  const Statistics statistics = statisticsOf(probed.times);
  const DriverSample& sample = probed.sample;
  std::cout << probed.answered << " of " << probed.times.size()
            << " exchanges answered in a second; median " << std::lround(statistics.median)
            << " us, longest " << std::lround(statistics.high) << " us"
            << (sample.homed ? "" : "; not homed yet") << (sample.stopped ? "; stopped" : "");
  if (sample.temperature > 0.0)
  {
    std::cout << "; motors at " << sample.temperature << " deg C";
  }
  std::cout << '\n';
  return 0;
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

// what is said of --device where a name is wrong is meant for the option that gave it
template <typename Work>
int namedBy(const std::string& option, const Work& work)
{
  constexpr std::string_view kMeant = "--device";
  try
  {
    return work();
  }
  catch (const Error& error)
  {
    const std::string_view what = error.what();
    if (!what.starts_with(kMeant))
    {
      throw;
    }
    throw Error(error.code(), option + std::string(what.substr(kMeant.size())));
  }
}

} // namespace

int showDevices(const DevicesOptions& options)
{
  if (!options.identify.empty())
  {
    return namedBy("--identify", [&] { return identifyDevice(options.identify, options.added); });
  }
  if (!options.home.empty())
  {
    return homeDevice(options.home);
  }
  if (!options.probe.empty())
  {
    return namedBy("--probe", [&] { return probe(options.probe); });
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
