// Stands in for hid_transport.cpp, usb_transport.cpp and haply_driver.cpp: they come with the
// module palp-usb, when the first device is looked for.

#include "haptics/devices/haply/haply_driver.h"
#include "haptics/devices/usb/found_device.h"
#include "haptics/devices/usb/hid_transport.h"
#include "haptics/devices/usb/usb_module.h"
#include "haptics/devices/usb/usb_transport.h"
#include "haptics/error.h"
#include "haptics/files/prefix.h"

#include <dlfcn.h>
#include <filesystem>

namespace palp
{
namespace
{

const UsbModule& loadModule()
{
  const std::filesystem::path file = prefix() / "lib/palp/palp-usb.so";
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL); // stays: drivers live in it
  using Entry = const UsbModule* (*)();
  const auto entry =
    library ? reinterpret_cast<Entry>(dlsym(library, kUsbModuleEntry)) : Entry{ nullptr };
  if (!entry)
  {
    throw Error(ErrorCode::NoDevice,
      file.string() + ": cannot be loaded; build or install the whole of palp");
  }
  return *entry();
}

const UsbModule& module()
{
  static const UsbModule& loaded = loadModule();
  return loaded;
}

} // namespace

std::vector<FoundDevice> listHid()
{
  return module().listHid();
}

std::unique_ptr<Transport> openHid(const std::string& path)
{
  return module().openHid(path);
}

std::vector<FoundDevice> listUsb()
{
  return module().listUsb();
}

std::unique_ptr<SerialTransport> openFalcon()
{
  return module().openFalcon();
}

std::unique_ptr<Driver> openHaply(const std::string& port)
{
  return module().openHaply(port);
}

} // namespace palp
