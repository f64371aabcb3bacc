#include "haptics/devices/usb/hid_transport.h"

#include "haptics/devices/file_transport.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <hidapi/hidapi.h>
#include <linux/hidraw.h>
#include <mutex>
#include <set>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace palp
{
namespace
{

// hidapi keeps its last error in one place: one thread at a time may look
std::mutex gLibrary;

struct Known
{
  unsigned short vendor;
  unsigned short product; // 0: by its usage
  unsigned short usagePage;
  unsigned short usage; // 0: any
  DeviceKind kind;
  const char* name;
};

// usages decide where one vendor has many products; generic ids are never more than RawHid
// @source  FreeSpacenav/spacenavd dev.c; forsslund/haptikfabrikenapi; pjrc.com/teensy/rawhid.html
constexpr std::array kKnown{
  Known{ 0x046d, 0, 0x0001, 0x0008, DeviceKind::SpaceMouse, "SpaceMouse (Logitech)" },
  Known{ 0x256f, 0, 0x0001, 0x0008, DeviceKind::SpaceMouse, "SpaceMouse (3Dconnexion)" },
  Known{ 0x16c0, 0x0486, 0xffab, 0x0200, DeviceKind::RawHid, "Teensy raw HID" },
  Known{ 0x1234, 0x0006, 0, 0, DeviceKind::RawHid, "mbed HID" },
};

const Known* find(const hid_device_info& info) noexcept
{
  const auto known = std::ranges::find_if(kKnown,
    [&](const Known& one)
    {
      return one.vendor == info.vendor_id && (one.product == 0 || one.product == info.product_id) &&
        (one.usage == 0 || (one.usagePage == info.usage_page && one.usage == info.usage));
    });
  return known == kKnown.end() ? nullptr : &*known;
}

std::string unusableReasonOf(const char* path)
{
  if (access(path, R_OK | W_OK) == 0)
  {
    return {};
  }
  return errno == EACCES
    ? "no permission; install the udev rules (cmake --install), then plug it in again"
    : "cannot be opened; plug it in again";
}

bool isHid(int file) noexcept
{
  struct stat status
  {
  };
  int size = 0;
  return fstat(file, &status) == 0 && S_ISCHR(status.st_mode) &&
    ioctl(file, HIDIOCGRDESCSIZE, &size) >= 0 && size > 0;
}

std::string narrow(const wchar_t* text)
{
  std::string narrowed;
  for (; text != nullptr && *text != 0; ++text)
  {
    narrowed += *text >= L' ' && *text < 127 ? static_cast<char>(*text) : '?';
  }
  return narrowed;
}

} // namespace

const char* hidUnusableReason() noexcept
{
  return "";
}

std::vector<FoundDevice> listHid()
{
  const std::lock_guard lock(gLibrary);
  std::vector<FoundDevice> found;
  std::set<std::string> paths; // one entry for each usage of an interface otherwise
  const std::unique_ptr<hid_device_info, decltype(&hid_free_enumeration)> all(
    hid_enumerate(0, 0), &hid_free_enumeration);
  for (const hid_device_info* info = all.get(); info != nullptr; info = info->next)
  {
    const Known* known = find(*info);
    if (known == nullptr || !paths.insert(info->path).second)
    {
      continue;
    }
    std::array<char, 10> ids{};
    std::snprintf(ids.data(), ids.size(), "%04x:%04x", info->vendor_id, info->product_id);
    const std::string product = narrow(info->product_string);
    found.push_back({ .kind = known->kind,
      .name = product.empty() ? known->name : product,
      .ids = ids.data(),
      .path = info->path,
      .unusableReason = unusableReasonOf(info->path) });
  }
  return found;
}

std::unique_ptr<Transport> openHid(const std::string& path)
{
  // a file of our own, not hidapi's: a guardian shares it, and a lock on it keeps others out
  const int file = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0 && errno != EISDIR)
  {
    throw Error(ErrorCode::NoDevice, path + ": " + unusableReasonOf(path.c_str()));
  }
  auto transport = std::make_unique<FileTransport>(file);
  if (!isHid(file))
  {
    throw Error(ErrorCode::NoDevice, path + ": not a HID device; see palp devices");
  }
  if (!takeForOneself(file))
  {
    throw Error(ErrorCode::NoDevice, path + ": is driven by another palp; close it");
  }
  return transport;
}

} // namespace palp
