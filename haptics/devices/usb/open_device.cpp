#include "haptics/devices/usb/open_device.h"

#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace palp
{
namespace
{

// kind and what stands behind its colon
std::pair<std::string, std::string> parts(const std::string& name)
{
  const std::size_t colon = name.find(':');
  return { name.substr(0, colon), colon == name.npos ? "" : name.substr(colon + 1) };
}

std::string onlySpaceMouse()
{
  const std::vector<FoundDevice> all = listHid();
  const auto mouse = std::ranges::find_if(all,
    [](const FoundDevice& one)
    { return one.kind == DeviceKind::SpaceMouse && one.unusableReason.empty(); });
  if (mouse == all.end())
  {
    throw Error(ErrorCode::NoDevice,
      "SpaceMouse: none that can be used; plug it in, and see palp devices for why");
  }
  return mouse->path;
}

// path and configuration of a board
std::pair<std::string, std::string> boardParts(const std::string& rest)
{
  const std::size_t comma = rest.find(',');
  return { rest.substr(0, comma), comma == rest.npos ? "" : rest.substr(comma + 1) };
}

// what the board at a path is; empty where none is
std::string boardAt(const std::string& path)
{
  const std::vector<FoundDevice> all = listHid();
  const auto board = std::ranges::find(all, path, &FoundDevice::path);
  return board == all.end() ? "" : board->ids + " " + board->name;
}

std::unique_ptr<Driver> makeDriver(const std::string& kind, const std::string& rest)
{
  if (kind == "spacemouse")
  {
    return std::make_unique<SpaceMouseDriver>(openHid(rest.empty() ? onlySpaceMouse() : rest));
  }
  if (kind == "falcon")
  {
    const std::string text = rest.empty() ? "" : readText(rest, "the firmware");
    const Bytes bytes = std::as_bytes(std::span(text));
    return std::make_unique<FalconDriver>(
      openFalcon(), std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  if (rest.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--device: " + kind +
        " needs its path, because many boards have the same ids; see palp devices");
  }
  if (kind == "phd1")
  {
    return std::make_unique<Phd1Driver>(openHid(rest));
  }
  const auto [path, configuration] = boardParts(rest);
  const WoodenArm arm = configuration.empty()
    ? WoodenArm{}
    : parseWoodenArm(readText(configuration, "the configuration"), configuration);
  const bool isMbed = boardAt(path).starts_with("1234:0006");
  return std::make_unique<WoodenDriver>(openHid(path), arm, isMbed ? 14 : 64);
}

} // namespace

std::vector<FoundDevice> findDevices()
{
  std::vector<FoundDevice> all = listHid();
  std::ranges::move(listUsb(), std::back_inserter(all));
  return all;
}

std::vector<std::string> namesOf(const FoundDevice& device)
{
  switch (device.kind)
  {
    case DeviceKind::SpaceMouse:
      return { "spacemouse:" + device.path };
    case DeviceKind::Falcon:
      return { "falcon" };
    default:
      return { "wooden:" + device.path, "phd1:" + device.path };
  }
}

bool namesHardware(const std::string& name)
{
  const std::string kind = parts(name).first;
  return kind == "spacemouse" || kind == "falcon" || kind == "wooden" || kind == "phd1";
}

std::unique_ptr<Driver> openDriver(const std::string& name)
{
  if (!namesHardware(name))
  {
    throw Error(ErrorCode::BadValue,
      "--device: '" + name + "' is no device; give spacemouse, falcon, wooden:PATH or phd1:PATH");
  }
  const auto [kind, rest] = parts(name);
  return makeDriver(kind, rest);
}

std::unique_ptr<Device> openDevice(const std::string& name, const DevicePlacement& placement)
{
  // another board may get the path of one that was unplugged; the user has chosen that one
  const std::string path = boardParts(parts(name).second).first;
  return std::make_unique<ThreadedDevice>(
    [name, path, chosen = boardAt(path)]
    {
      if (boardAt(path) != chosen)
      {
        throw Error(ErrorCode::NoDevice, name + ": another device is there now; choose it anew");
      }
      return openDriver(name);
    },
    placement);
}

} // namespace palp
