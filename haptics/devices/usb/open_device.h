#pragma once

#include "haptics/devices/threaded_device.h"

#include <filesystem>
#include <memory>
#include <string>

namespace palp
{

/// Opens what drives a device, by the name that a user gives it.
///
/// spacemouse, spacemouse:PATH; falcon, falcon:FIRMWARE; wooden:PATH[,ARM.conf]; phd1:PATH. A
/// board with generic ids is never opened without its path.
///
/// @throws Error  BadValue: not such a name; NoDevice: why it cannot be used, and what to do;
///                BadFile: firmware or configuration
[[nodiscard]] std::unique_ptr<Driver> openDriver(const std::string& name);

/// The same on a thread of its own, ready for the servo loop.
/// @throws Error  as openDriver
[[nodiscard]] std::unique_ptr<Device> openDevice(
  const std::string& name, const DevicePlacement& placement);

/// True when openDriver knows a name of this kind.
[[nodiscard]] bool namesHardware(const std::string& name);

} // namespace palp
