#include "haptics/devices/usb/open_device.h"

#include "haptics/devices/falcon/falcon_driver.h"
#include "haptics/devices/forcedimension/forcedimension_driver.h"
#include "haptics/devices/gamepad/gamepad_driver.h"
#include "haptics/devices/guard/guarded_driver.h"
#include "haptics/devices/haply/haply_driver.h"
#include "haptics/devices/hid/hid_drivers.h"
#include "haptics/devices/identify/identified_driver.h"
#include "haptics/devices/openigtlink/openigtlink_driver.h"
#include "haptics/devices/serial/serial_port.h"
#include "haptics/devices/serial/wooden_text.h"
#include "haptics/devices/spacenav/spacenav_driver.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"
#include "haptics/files/checksum.h"
#include "haptics/files/input_text.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

namespace palp
{
namespace
{

constexpr const char* kUsualArm = "v2015";

// kind and what stands behind its colon
std::pair<std::string, std::string> parts(const std::string& name)
{
  const std::size_t colon = name.find(':');
  return { name.substr(0, colon), colon == name.npos ? "" : name.substr(colon + 1) };
}

// all of one mouse or receiver: which of its interfaces talks shows when it is moved
std::vector<std::unique_ptr<Transport>> openSpaceMice()
{
  std::vector<std::unique_ptr<Transport>> opened;
  std::string ids;
  for (const FoundDevice& one : listHid())
  {
    if (one.kind == DeviceKind::SpaceMouse && one.unusableReason.empty() &&
      (ids.empty() || ids == one.ids))
    {
      ids = one.ids;
      opened.push_back(openHid(one.path));
    }
  }
  if (opened.empty())
  {
    throw Error(ErrorCode::NoDevice,
      "SpaceMouse: none that can be used; plug it in, and see palp devices for why");
  }
  return opened;
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

// of a board's arm: its published name, or its file with what stands in it
std::string configurationOf(const std::string& rest)
{
  const std::string named = boardParts(rest).second;
  if (named.empty() || !std::filesystem::is_regular_file(named))
  {
    return named.empty() ? kUsualArm : named;
  }
  std::ostringstream text;
  text << std::filesystem::path(named).stem().string() << ' ' << std::hex
       << checksumOf(readText(named, "the configuration"));
  return text.str();
}

using Opener = std::unique_ptr<Driver> (*)(const std::string& rest);

std::unique_ptr<Driver> openSpaceMouse(const std::string& rest)
{
  return rest.empty() ? std::make_unique<SpaceMouseDriver>(openSpaceMice())
                      : std::make_unique<SpaceMouseDriver>(openHid(rest));
}

std::unique_ptr<Driver> openFalconArm(const std::string& rest)
{
  const std::string text = rest.empty() ? "" : readText(rest, "the firmware");
  const Bytes bytes = std::as_bytes(std::span(text));
  return guardedUsb(openFalcon(), falconZero(),
    [&](std::unique_ptr<SerialTransport> wire)
    {
      return std::make_unique<FalconDriver>(
        std::move(wire), std::vector<std::byte>(bytes.begin(), bytes.end()));
    });
}

void requirePath(const std::string& kind, const std::string& rest)
{
  if (rest.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--device: " + kind +
        " needs its path, because many boards have the same ids; see palp devices");
  }
}

std::unique_ptr<Driver> openPhd1(const std::string& rest)
{
  requirePath("phd1", rest);
  return guarded(openHid(rest), phd1Zero(),
    [](std::unique_ptr<Transport> wire) { return std::make_unique<Phd1Driver>(std::move(wire)); });
}

// by HID, or in lines of text where the path is a serial port
std::unique_ptr<Driver> openWooden(const std::string& rest)
{
  const auto [path, configuration] = boardParts(rest);
  requirePath("wooden", path);
  const auto published = publishedArm(configuration.empty() ? kUsualArm : configuration);
  if (!published && !std::filesystem::exists(configuration))
  {
    throw Error(ErrorCode::BadValue,
      "--device: '" + configuration +
        "' is neither an arm nor a file; give v2015, v2019, polhem, aluhaptics or a file of yours");
  }
  const WoodenArm arm = published
    ? *published
    : parseWoodenArm(readText(configuration, "the configuration"), configuration);
  if (isSerialPort(path))
  {
    return guarded(openSerialPort(path), woodenTextZero(),
      [&](std::unique_ptr<Transport> wire)
      {
        return std::make_unique<WoodenDriver>(
          std::make_unique<WoodenText>(std::move(wire)), arm, kWoodenReport);
      });
  }
  const std::size_t report = boardAt(path).starts_with("1234:0006") ? kWoodenReport : 64;
  return guarded(openHid(path), woodenZero(report),
    [&](std::unique_ptr<Transport> wire)
    { return std::make_unique<WoodenDriver>(std::move(wire), arm, report); });
}

struct Kind
{
  std::string_view name;
  Opener open;
};

constexpr std::array kKinds{
  Kind{ "spacemouse", openSpaceMouse },
  Kind{ "spacenavd", [](const std::string&) { return openSpacenav(); } },
  Kind{ "gamepad", openGamepad },
  Kind{ "falcon", openFalconArm },
  Kind{ "wooden", openWooden },
  Kind{ "phd1", openPhd1 },
  Kind{ "openigtlink", openOpenIgtLink },
  Kind{ "haply", openHaply },
  Kind{ "forcedimension", openForceDimension },
};

const Kind* kindOf(const std::string& name)
{
  const auto kind = std::ranges::find(kKinds, parts(name).first, &Kind::name);
  return kind == kKinds.end() ? nullptr : &*kind;
}

} // namespace

std::vector<FoundDevice> findDevices()
{
  std::vector<FoundDevice> all = listHid();
  std::ranges::move(listUsb(), std::back_inserter(all));
  for (const FoundGamepad& pad : listGamepads())
  {
    all.push_back({ .kind = DeviceKind::Gamepad,
      .name = pad.name + (pad.rumbles ? ", rumbles" : ", does not rumble"),
      .path = pad.path });
  }
  for (const SerialPort& port : serialPorts())
  {
    all.push_back({ .kind = DeviceKind::Serial,
      .name = "serial port",
      .path = port.path,
      .unusableReason = port.permitted ? "" : kSerialPermission });
  }
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
    case DeviceKind::Gamepad:
      return { "gamepad:" + device.path };
    case DeviceKind::Serial:
      return { "wooden:" + device.path };
    default:
      return { "wooden:" + device.path, "phd1:" + device.path };
  }
}

bool namesHardware(const std::string& name)
{
  return kindOf(name) != nullptr;
}

std::unique_ptr<Driver> openDriver(const std::string& name)
{
  const Kind* kind = kindOf(name);
  if (kind == nullptr)
  {
    throw Error(
      ErrorCode::BadValue, "--device: '" + name + "' is no device; give " + kHardwareNames);
  }
  return kind->open(parts(name).second);
}

std::unique_ptr<Driver> openHoming(const std::string& name)
{
  const auto [kind, rest] = parts(name);
  if (kind != "phd1" || rest.empty())
  {
    throw Error(ErrorCode::BadValue,
      "--home: '" + name + "' is no device that homes by itself; give phd1:PATH");
  }
  return guarded(openHid(rest), phd1Zero(),
    [](std::unique_ptr<Transport> wire)
    {
      auto driver = std::make_unique<Phd1Driver>(std::move(wire));
      driver->home();
      return driver;
    });
}

std::string identityOf(const std::string& name)
{
  const auto [kind, rest] = parts(name);
  const std::string board = rest.empty() ? "" : boardAt(boardParts(rest).first);
  std::string identity = kind;
  for (const std::string& part : { board, kind == "wooden" ? configurationOf(rest) : "" })
  {
    identity.append(part.empty() ? "" : " ").append(part);
  }
  return identity;
}

std::unique_ptr<Device> openDevice(const std::string& name, const DevicePlacement& placement,
  const std::optional<IdentifiedArm>& arm)
{
  if (arm && !arm->agrees())
  {
    throw Error(ErrorCode::NoDevice,
      name +
        ": its motion does not follow its motors, so that no force is safe; mend `sign` in its "
        "configuration, then palp devices --identify");
  }
  // another board may get the path of one that was unplugged; the user has chosen that one
  const std::string path = boardParts(parts(name).second).first;
  return std::make_unique<BusDevice>(
    [name, path, arm, chosen = boardAt(path)]() -> std::unique_ptr<Driver>
    {
      if (boardAt(path) != chosen)
      {
        throw Error(ErrorCode::NoDevice, name + ": another device is there now; choose it anew");
      }
      return arm ? std::make_unique<IdentifiedDriver>(openDriver(name), *arm) : openDriver(name);
    },
    placement);
}

} // namespace palp
