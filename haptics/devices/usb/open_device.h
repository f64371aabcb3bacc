#pragma once

#include "haptics/devices/arm.h"
#include "haptics/devices/bus_device.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace palp
{

/// For people: the names that openDriver takes.
inline constexpr const char* kHardwareNames =
  "spacemouse, spacenavd, gamepad, falcon, wooden:PATH, phd1:PATH, haply, forcedimension "
  "or openigtlink";

/// Opens what drives a device, by the name that a user gives it.
///
/// spacemouse, spacemouse:PATH; spacenavd; gamepad[:PATH]; falcon, falcon:FIRMWARE;
/// wooden:PATH[,ARM], a HID board or a serial port, and an arm of publishedArm or a file;
/// phd1:PATH; haply[:PORT]; forcedimension[:LIBRARY]; openigtlink[:ADDRESS:PORT][,TOOL]. A board
/// with generic ids is never opened without its path.
///
/// @throws Error  BadValue: not such a name; NoDevice: why it cannot be used, and what to do;
///                BadFile: firmware or configuration
[[nodiscard]] std::unique_ptr<Driver> openDriver(const std::string& name);

/// The same of a PHD1 board that is to move to its zero by itself.
/// @throws Error  as openDriver; BadValue: another device
[[nodiscard]] std::unique_ptr<Driver> openHoming(const std::string& name);

/// The same on a thread of its own, ready for the servo loop.
/// @param arm     what was measured of it; its limits are then those of this arm
/// @throws Error  as openDriver; NoDevice: its motion does not follow its motors
[[nodiscard]] std::unique_ptr<Device> openDevice(const std::string& name,
  const DevicePlacement& placement, const std::optional<IdentifiedArm>& arm = std::nullopt);

/// What tells a device from those of other kinds, wherever it is plugged in: its kind and, of a
/// board, its ids, its name and its configuration, whose signs a measurement vouches for. Two
/// boards alike are one.
/// @throws Error  BadFile: the file of its configuration cannot be read
[[nodiscard]] std::string identityOf(const std::string& name);

/// True when openDriver knows a name of this kind.
[[nodiscard]] bool namesHardware(const std::string& name);

} // namespace palp
