#pragma once

#include "haptics/devices/driver.h"
#include "haptics/devices/usb/found_device.h"

#include <memory>

namespace palp
{

/// What the module palp-usb carries: all that touches hidapi, libusb and libwebsockets.
struct UsbModule
{
  std::vector<FoundDevice> (*listHid)();
  std::unique_ptr<Transport> (*openHid)(const std::string& path);
  std::vector<FoundDevice> (*listUsb)();
  std::unique_ptr<SerialTransport> (*openFalcon)();
  std::unique_ptr<Driver> (*openHaply)(const std::string& port);
};

/// Name of the module's one function, of type `const UsbModule* ()`.
constexpr const char* kUsbModuleEntry = "palpUsbModule";

} // namespace palp
